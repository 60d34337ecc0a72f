// stencils.hpp: differences through a few points.
//
//   f' = sum_i w_i f(p + k_i h) / h          k_i: points, w_i: weights
//
// `check` are weights of lower order through the same points: where both differ the function is not smooth there.
#pragma once

#include <vector>

namespace signorini {

/// Points in units of the step, and weights over it.
struct Stencil {
  std::vector<int> points;
  std::vector<double> weights, check;  ///< check: of lower order, through the same points
};

/// Exact for what is linear, or a parabola.
[[nodiscard]] const Stencil& two_points();
/// Of sixth order, checked by the fourth.
[[nodiscard]] const Stencil& six_points();
/// Of fifth order, checked by the fourth; to the upper side, to the lower one h is negative.
[[nodiscard]] const Stencil& one_side();

}  // namespace signorini
