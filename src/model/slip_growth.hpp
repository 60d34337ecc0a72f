// slip_growth.hpp: instability of steady slip at the friction limit.
//
//   M u'' + C u' + (K + sum kn (n - s f t) n^T + sum_stick kt t t^T) u = 0,   u ~ exp(lambda t)
//
// Friction proportional to the normal force makes the stiffness unsymmetric. Two frequencies may then coincide and
// become lambda = gamma +- i omega, gamma > 0 (flutter), or one frequency may become zero (lambda = gamma: divergence).
// With 1 / nu = lambda - sigma, sigma > 0 near the frequencies of interest:
//
//   nu z = A z,   A = [ -K~^-1 (C + 2 sigma M)   -K~^-1 M ],   K~ = K + sigma C + sigma^2 M
//                     [  I                        0       ]
//
// Models with up to 100 degrees of freedom are examined without reduction. With up to 400, the 100 lowest modes of
// the symmetric part are used, and results up to half of the highest of these frequencies are reported. Larger models
// are not examined. Rigid contacts are represented by springs of 10^4 times the structure's own stiffness.
#pragma once

#include <optional>

#include "signorini/model.hpp"

namespace signorini::model {

// Bounds of the decay rates of motions, without computation of modes.
//
//   by damping alpha M + beta K   alpha + beta omega^2 at the frequency omega, with the damping ratio
//                                 (alpha / omega + beta omega) / 2
//   by the diagonals              C_ii / M_ii, and K_ii / C_ii where there is no mass

/// The largest rate given by the diagonals of M, C and K. Unit: 1/time.
[[nodiscard]] double diagonal_decay(const Vector& mass, const Vector& damping, const Vector& stiffness);

/// The fastest decay, 1/time: from the damping alpha M + beta K at omega_max, or from the diagonals, dashpots and
/// springs of contacts included.
[[nodiscard]] double fastest_decay(const Model& model);

/// Smallest damping ratio of any frequency up to omega_max, in any contact state (contact springs are not part of the
/// damping beta K); 0 if unknown.
[[nodiscard]] double min_damping_ratio(const Model& model);

struct SlipGrowth {
  double rate = 0.0;                  ///< gamma, > 0; 1/time
  double omega = 0.0;                 ///< rad per time; 0: divergence
  std::vector<std::size_t> contacts;  ///< slipping contacts with friction proportional to the normal force
};

/// The fastest growing motion; nullopt if no motion grows. states: one entry per contact. The model must have its damping, but
/// must not be reduced and not have shear elements.
[[nodiscard]] std::optional<SlipGrowth> slip_growth(const Model& model, const std::vector<State>& states);

}  // namespace signorini::model
