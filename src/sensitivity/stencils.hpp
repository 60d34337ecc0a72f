// stencils.hpp: finite-difference stencils.
//
//   f' = sum_i w_i f(p + k_i h) / h          k_i: points, w_i: weights
//
// `check` are weights of lower order at the same points: where both results differ, the function is not smooth.
#pragma once

#include <vector>

namespace signorini {

/// Points in units of the step, and weights divided by the step.
struct Stencil {
  std::vector<int> points;
  std::vector<double> weights, check;  ///< check: weights of lower order at the same points
};

/// Exact for linear and quadratic functions.
[[nodiscard]] const Stencil& two_points();
/// Sixth order, checked by fourth order.
[[nodiscard]] const Stencil& six_points();
/// Fifth order, checked by fourth order; for the upper side; h is negative for the lower side.
[[nodiscard]] const Stencil& one_side();

}  // namespace signorini
