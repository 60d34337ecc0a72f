// multipliers.hpp: Floquet multipliers of an orbit, and which way it loses stability.
//
//   Phi x = mu x;    stable where |mu| < 1 for all but those of families, and of time where the orbit is driven by itself
//   fold: mu > 1,  flip: mu < -1,  Neimark-Sacker: a pair outside the unit circle
//
// error: how far the multipliers of two matrices are apart that were computed from two states of one orbit, and how far Phi
// may be off: rounding of its entries, what all steps of its tangents leave (both evaluations share that), and what the
// error of the orbit's states makes of it. A multiplier whose distance from the unit circle is below it is undecided.
//
// Where the energy is kept multipliers come in pairs mu, 1/mu: none dies out, so such an orbit is unstable or undecided. Two
// equal ones, as 1 along the motion and from energy to energy, move apart by the square root of an error of Phi: this is the
// error of their distance from the circle.
#pragma once

#include "signorini/orbit.hpp"

#include <Eigen/Core>

#include <cmath>

namespace signorini {

using Multipliers = std::vector<std::complex<double>>;

/// Eigenvalues of Phi, by magnitude, descending.
[[nodiscard]] Multipliers multipliers_of(const Eigen::MatrixXd& phi);

/// Multipliers that are 1 within the rounding of Phi.
[[nodiscard]] std::size_t count_ones(const Multipliers& all);

/// Without the `count` that are nearest to 1.
[[nodiscard]] Multipliers without_ones(Multipliers all, std::size_t count);

/// How far Phi may be off, and so its simple multipliers; states: error of the orbit's states over the amplitude.
[[nodiscard]] double error_of(const Eigen::MatrixXd& phi, double rates_error, double states);

/// From the unit circle. error: of multipliers; keeps: the energy is kept.
[[nodiscard]] inline double error_at_circle(double error, bool keeps) {
  return keeps ? std::sqrt(error) : error;
}

/// Puts multipliers, their error, stability and loss into the orbit. all: those of phi; again: Phi from the image of the
/// state, or empty; ones: how many multipliers are 1 for reasons of their own; error: error_of(phi); keeps: the energy is kept.
void set_multipliers(const Multipliers& all, const Eigen::MatrixXd& again, std::size_t ones, double error,
                     bool keeps, Orbit& orbit);

}  // namespace signorini
