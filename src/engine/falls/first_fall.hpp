// first_fall.hpp: the first downward zero crossing of a polynomial, with proof that none was missed.
//
//   p(x) = sum_k a_k x^k = sum_i b_i B_i,n(x) on an interval:   min b_i <= p <= max b_i,
//   and p has at most as many zeros there as the b_i have changes of sign (Descartes)
//
// An interval contains no zero if all b_i > slack. One change of sign from above slack to below -slack means exactly
// one zero. Otherwise the interval is halved (de Casteljau), which sharpens the bounds quadratically. `slack` bounds
// the error of p itself: the remainder of the series and the rounding of its terms. So a crossing is found or excluded;
// only where |p| stays within slack neither can be shown.
// Source: Farin, Curves and Surfaces for CAGD, chapter 6 (Bernstein form, variation diminishing).
#pragma once

#include <cstddef>

namespace signorini {

struct FirstFall {
  enum class Kind {
    none,   ///< p > 0 on [0, 1], up to slack
    fall,   ///< p > 0 before x, p < 0 after it
    touch,  ///< like none, but |p| <= slack around x: a crossing there cannot be decided
    lost,   ///< coefficients or slack are not finite: no statement is possible
  } kind = Kind::none;
  double x = 0.0;
  std::size_t intervals = 0;  ///< number of intervals examined: the cost
};

inline constexpr std::size_t most_fall_degree = 32;

/// a: degree + 1 coefficients, degree <= most_fall_degree; p(0) is positive up to slack.
[[nodiscard]] FirstFall first_fall(const double* a, std::size_t degree, double slack);

}  // namespace signorini
