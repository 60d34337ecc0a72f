// multipliers.hpp: Floquet multipliers of an orbit, and which way it loses stability.
//
//   Phi x = mu x;    stable where |mu| < 1 for all but those of families, and of time where the orbit is driven by itself
//   fold: mu > 1,  flip: mu < -1,  Neimark-Sacker: a pair outside the unit circle
//
// error: how far the multipliers of two matrices are apart that were computed from two states of one orbit, what
// rounding leaves of the greatest entry of Phi, and what the error of the orbit's states makes of it.
#pragma once

#include "signorini/orbit.hpp"

#include <Eigen/Core>

namespace signorini {

using Multipliers = std::vector<std::complex<double>>;

/// Eigenvalues of Phi, by magnitude, descending.
[[nodiscard]] Multipliers multipliers_of(const Eigen::MatrixXd& phi);

/// Multipliers that are 1 within the rounding of Phi.
[[nodiscard]] std::size_t count_ones(const Multipliers& all);

/// Without the `count` that are nearest to 1.
[[nodiscard]] Multipliers without_ones(Multipliers all, std::size_t count);

/// Puts multipliers, their error, stability and loss into the orbit. all: those of phi; again: Phi from the image of the
/// state, or empty; ones: how many multipliers are 1 for reasons of their own; state_error: of states over the amplitude.
void set_multipliers(const Multipliers& all, const Eigen::MatrixXd& phi, const Eigen::MatrixXd& again,
                     std::size_t ones, double state_error, Orbit& orbit);

}  // namespace signorini
