// neighbour.hpp: the same scene, disturbed as much as an engine's error may disturb it.
//
//   M u'' + C u' + K u = P(t) + d(t) - ...,   gap += delta u r,   e = min(1, e (1 + delta q))
//   d_i = delta M_ii ( w_i v_i cos(w_i t + phi_i)
//                      + w_0^2 u_i ( cos(w_0 t + psi_i) + k_i cos(k_i w_0 t + chi_i) ) )
//   w_0 = 2 pi / t_end
//
// v_i, u: scale plus greatest value (Weights), w_i at random between the length of the run and the highest
// frequency, k_i from 1 to 100, r in [-1, 1] for contacts that start open, q in [-1, 1] for rigid ones, for
// e = 1 never positive. The first wave changes v_i by about delta of its size, again and again over the run,
// the second one u_i: an error of u moves every hit, also those of contacts that start closed, whose gaps
// stay as they are. The third changes u_i by delta/k of its size within 1/k of the run: errors that are made
// in short flights. An engine that restarts at each hit makes much the same error after each, and so loses or
// gains energy hit by hit: the k-th is off by k^2. No wave does that; e does. Else laws and states stay as
// they are.
#pragma once

#include <cstdint>

#include "differential/deviation.hpp"

namespace signorini::differential {

[[nodiscard]] Model neighbour(const Model& model, const Weights& weights, double delta, double t_end,
                              std::uint64_t seed);

}  // namespace signorini::differential
