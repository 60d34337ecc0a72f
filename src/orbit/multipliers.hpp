// multipliers.hpp: Floquet multipliers of an orbit, and the type of its loss of stability.
//
//   Phi x = mu x;    stable if |mu| < 1, except for structural multipliers 1
//                    (of families, and of time for self-excited orbits)
//   fold: mu > 1,  flip: mu < -1,  Neimark-Sacker: a pair outside the unit circle
//
// error: sum of two parts. The first part is the distance between the multipliers of two matrices Phi,
// computed from two states of one orbit. The second part is the error common to both matrices: rounding of
// the entries, errors of the tangents' steps, and effects of errors of the orbit's states. A multiplier is
// undecided if its distance from the unit circle is below this error.
//
// If energy is conserved, multipliers occur in pairs mu, 1/mu. No disturbance dies out, so such an orbit is
// unstable or undecided. An error of Phi separates two equal multipliers by its square root. Conservative
// orbits have such a pair: the two multipliers 1, along the motion and along neighbouring energies. Therefore
// sqrt(error) is the error of the distance from the unit circle.
#pragma once

#include "signorini/orbit.hpp"

#include <Eigen/Core>

#include <cmath>

namespace signorini::orbit {

using Multipliers = std::vector<std::complex<double>>;

/// Eigenvalues of Phi, by descending magnitude.
[[nodiscard]] Multipliers multipliers_of(const Eigen::MatrixXd& phi);

/// Number of multipliers that are 1 within the rounding of Phi.
[[nodiscard]] std::size_t count_ones(const Multipliers& all);

/// All multipliers except the `count` multipliers nearest to 1.
[[nodiscard]] Multipliers without_ones(Multipliers all, std::size_t count);

/// Error of Phi, and thus of its simple multipliers. derivatives_error: OrbitPass::derivatives_error; states: error of
/// the orbit's states / amplitude.
[[nodiscard]] double error_of(const Eigen::MatrixXd& phi, double derivatives_error, double states);

/// Error of the distance from the unit circle. error: error of the multipliers; keeps: true if energy is conserved.
[[nodiscard]] inline double error_at_circle(double error, bool keeps) {
  return keeps ? std::sqrt(error) : error;
}

/// Sets multipliers, their error, stability and loss of the orbit. all: multipliers of this period's Phi;
/// again: Phi of the next period, or empty; ones: number of structural multipliers 1; error: from error_of();
/// keeps: true if energy is conserved.
void set_multipliers(const Multipliers& all, const Eigen::MatrixXd& again, std::size_t ones, double error,
                     bool keeps, Orbit& orbit);

}  // namespace signorini::orbit
