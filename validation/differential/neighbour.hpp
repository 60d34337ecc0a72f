// neighbour.hpp: the same scene, disturbed as much as an engine's error may disturb it.
//
//   M u'' + C u' + K u = P(t) + d(t) - ...,   gap += delta u r
//   d_i = delta M_ii ( w_i v_i cos(w_i t + phi_i) + w_0^2 u_i cos(w_0 t + psi_i) ),   w_0 = 2 pi / t_end
//
// v_i, u: scale plus greatest value (Weights), w_i at random between the length of the run and the highest
// frequency, r in [-1, 1] for contacts that start open. The first wave changes v_i by about delta of its size,
// again and again over the run, the second one u_i: an error of u moves every hit, also those of contacts that
// start closed, whose gaps stay as they are. Laws and states do, too.
#pragma once

#include <cstdint>

#include "differential/deviation.hpp"

namespace signorini::differential {

[[nodiscard]] Model neighbour(const Model& model, const Weights& weights, double delta, double t_end,
                              std::uint64_t seed);

}  // namespace signorini::differential
