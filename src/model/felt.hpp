// felt.hpp: effective amplitude of a load or a compression that acts only for a short time.
//
//   effective amplitude = min( A, c w J ),   A = max |f|,   J = max_t int_t^(t + 1/w) |f| dt,   c = 16
//
// An oscillator of frequency w at rest responds with |u| <= min( 2 A, w int |f| dt ) / k. So a load that acts for more
// than 1/(c w) (a hundredth of the period) counts in full, a shorter one by its impulse. In J each piece of f counts
// with its largest |f|. w: frequency along the static response u = K^-1 p to the load, w^2 = u.p / u.M u, with
// initially closed contacts held, or the lowest frequency if there is no response. A motion that rotates by less than 1
// rad during the run is free: w = 64 / t_end, so a thousandth of the run counts in full.
#pragma once

#include <vector>

#include "model/modes/modes.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// Fractions of each load's largest amplitude.
struct FeltLoad {
  double share = 1.0;   ///< effective / full amplitude; exactly 1 for lasting loads
  double thrown = 1.0;  ///< the same for a free motion over the whole run: J over all of the run
};

struct Felt {
  std::vector<FeltLoad> loads;
  std::vector<double> compressions;  ///< fraction for each slider's normal_force, with w the lowest frequency
};

/// omega: lowest frequency of the constrained structure; 0: it has none.
[[nodiscard]] Felt felt_amplitudes(const Model& model, const Holding& holding, double omega, double t_end);

}  // namespace signorini
