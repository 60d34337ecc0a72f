// chebyshev.hpp: polynomials through values at nested Chebyshev points.
//
//   x_i = -cos(pi i / 16), i = 0, ..., 16, ascending on [-1, 1]; every second, fourth, eighth of them are
//   the points of degree 8, 4, 2
//   p(x) = sum w_i r_i / (x - x_i) / sum w_i / (x - x_i),   w_i = +-1, half at the ends
//   p'(x_i) = sum over j != i of  c_i/c_j (-1)^(i+j) / (x_i - x_j) (r_j - r_i),   c = 2 at the ends, else 1
//
// `stride` chooses the points: 1, 2, 4, 8 for degree 16, 8, 4, 2. Values have all 17 entries; the others are not read.
#pragma once

#include <array>
#include <cstddef>

namespace signorini {

struct Chebyshev {
  static constexpr std::size_t count = 17;
  using Values = std::array<double, count>;

  /// The 17 points.
  [[nodiscard]] static const Values& nodes();
  [[nodiscard]] static double through(const Values& values, std::size_t stride, double x);
  /// Derivative p' at the points of the stride.
  [[nodiscard]] static Values slopes(const Values& values, std::size_t stride);
  /// Zero of p' between two points at which its signs differ; `slope` is the result of slopes().
  [[nodiscard]] static double turn_between(const Values& slope, std::size_t stride, double a, double b);
};

}  // namespace signorini
