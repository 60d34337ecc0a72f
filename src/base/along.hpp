// along.hpp: low-degree polynomial through values at points along a line.
//
//   p(x) = sum_i L_i(x) f_i,   x_i = (1 - cos(pi i/(n - 1)))/2 in [0, 1],  degree n - 1;   n = 1: a constant
//
//   |p - the line through both ends| <= 2 max_i |f_i - the line at x_i|       (Lebesgue's constant, n <= 6)
//
// Extremes: both ends, and where p' is zero; its zeros lie between those of p'', and so on.
#pragma once

#include <array>
#include <cstddef>

namespace signorini {

struct Along {
  static constexpr std::size_t most = 6;  ///< limit for the number of points
  static constexpr double lebesgue = 2.0;
  using Values = std::array<double, most>;

  /// Position of the i-th of n points.
  [[nodiscard]] static double point(std::size_t n, std::size_t i);
  [[nodiscard]] static double through(const Values& f, std::size_t n, double x);

  /// The first position is given if several values are equal up to rounding.
  struct Extremes {
    double least = 0.0, greatest = 0.0, at_least = 0.0, at_greatest = 0.0;
  };
  [[nodiscard]] static Extremes extremes(const Values& f, std::size_t n);
};

}  // namespace signorini
