// excited_modes.hpp: Ritz vectors that replace the modes above a cutoff, for structures with too many modes.
//
//   span{ G f, G M G f, G (M G)^2 f, ... }:   K psi = omega^2 M psi in this span (Ritz),   psi^T M psi = 1,   psi^T M Phi = 0
//
// G: static response of the modes left out (model/reduce/kept_modes.hpp); f: forms of contacts and loads. The
// span also contains the part of the initial state outside the kept modes Phi. The static responses to all
// forces are exact. With k terms the first 2 k coefficients of the responses in powers of the frequency are
// exact, too, and include all modes left out. The Ritz vectors represent the lowest modes left out closely.
// Source: Wilson, Yuan and Dickens, Earthquake Engineering and Structural Dynamics 10 (1982) 813.
#pragma once

#include "model/reduce/kept_modes.hpp"
#include "signorini/model.hpp"

namespace signorini::reduction {

struct ExcitedModes {
  Eigen::VectorXd squares;  ///< omega^2, ascending
  Eigen::MatrixXd shapes;   ///< M-orthonormal
};

/// Ritz vectors above the cutoff. structure: result of build_structure(); kept: the structure's modes up to
/// the cutoff. Errors: NotReducible.
[[nodiscard]] ExcitedModes excited_modes(const Model& structure, const reduce::KeptModes& kept);

}  // namespace signorini::reduction
