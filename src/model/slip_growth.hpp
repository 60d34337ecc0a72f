// slip_growth.hpp: whether contacts that slip at their limits would let a motion grow.
//
//   M u'' + C u' + (K + sum kn (n - s f t) n^T + sum_stick kt t t^T) u = 0,   u ~ exp(lambda t)
//
// Friction that follows the compression makes the stiffness unsymmetric. Then pairs of frequencies may meet
// and part again as lambda = gamma +- i omega, gamma > 0 (flutter), or one may pass through zero
// (lambda = gamma: it runs away). With 1 / nu = lambda - sigma, sigma > 0 near the frequencies looked at:
//
//   nu z = A z,   A = [ -K~^-1 (C + 2 sigma M)   -K~^-1 M ],   K~ = K + sigma C + sigma^2 M
//                     [  I                        0       ]
//
// Up to 100 degrees of freedom all of them; up to 400 in the 100 lowest modes of the symmetric part, looked
// at up to half of their highest frequency; beyond, nothing is said. Rigid contacts are springs of 10^4 times
// the structure's own stiffness here.
#pragma once

#include <optional>

#include "signorini/model.hpp"

namespace signorini {

struct SlipGrowth {
  double rate = 0.0;                  ///< gamma, > 0; 1/time
  double omega = 0.0;                 ///< rad per time; 0: it runs away
  std::vector<std::size_t> contacts;  ///< those that slip with friction that follows their compression
};

/// The fastest growth, `states` one a contact. The model: before its reduction, damping set, without shear
/// elements.
[[nodiscard]] std::optional<SlipGrowth> slip_growth(const Model& model, const std::vector<State>& states);

}  // namespace signorini
