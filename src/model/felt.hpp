// felt.hpp: how large a load or a compression counts where its amplitude acts for a short time only.
//
//   felt = min( A, c w J ),   A = max |f|,   J = max_t int_t^(t + 1/w) |f| dt,   c = 16
//
// An oscillator of frequency w at rest answers with |u| <= min( 2 A, w int |f| dt ) / k. So a load that acts for more than
// 1/(c w) at once (a hundredth of the period) counts in full, as what lasts does, a shorter one by its impulse. In J each piece
// of f counts with its greatest |f|. w: of the swing along the static answer u = K^-1 p to the load, w^2 = u.p / u.M u,
// initially closed contacts held, or the lowest frequency where nothing answers. What turns by less than a radian in the run
// is free: w = 64 / t_end, a thousandth of the run counts in full.
#pragma once

#include <vector>

#include "model/modes/modes.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// Of each load, parts of its greatest amplitude.
struct FeltLoad {
  double share = 1.0;   ///< felt / A; exactly 1 for what lasts
  double thrown = 1.0;  ///< the same of what is thrown in the time of the run, J over all of it
};

struct Felt {
  std::vector<FeltLoad> loads;
  std::vector<double> compressions;  ///< share of each slider's normal_force, w the lowest frequency
};

/// omega: the lowest frequency of what is held; 0: it has none.
[[nodiscard]] Felt felt_amplitudes(const Model& model, const Holding& holding, double omega, double t_end);

}  // namespace signorini
