// excited_modes.hpp: what stands for the modes that a cutoff leaves out, where a structure has too many to compute them all.
//
//   span{ G f, G M G f, G (M G)^2 f, ... }:   K psi = omega^2 M psi there (Ritz),   psi^T M psi = 1,   psi^T M Phi = 0
//
// G: static answer of the modes left out (model/reduce/kept_modes.hpp), f: forms of contacts and loads, and what of the initial
// state the kept modes Phi do not have. So the static answers to all forces are exact, and with k terms the first 2 k
// coefficients of the answers in powers of the frequency: all modes left out have their part, the lowest ones nearly as themselves.
// Source: Wilson, Yuan and Dickens, Earthquake Engineering and Structural Dynamics 10 (1982) 813.
#pragma once

#include "model/reduce/kept_modes.hpp"
#include "signorini/model.hpp"

namespace signorini::reduction {

struct ExcitedModes {
  Eigen::VectorXd squares;  ///< omega^2, ascending
  Eigen::MatrixXd shapes;   ///< M-orthonormal
};

/// structure: build_structure's; `kept`: its modes up to the cutoff. Throws NotReducible.
[[nodiscard]] ExcitedModes excited_modes(const Model& structure, const reduce::KeptModes& kept);

}  // namespace signorini::reduction
