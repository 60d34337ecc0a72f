// first_root.hpp: the first downward zero crossing of a polynomial, with proof that none was missed.
//
//   p(x) = sum_k a_k x^k = sum_i b_i B_i,n(x) on an interval:   min b_i <= p <= max b_i,
//   and p has at most as many zeros there as the b_i have changes of sign (Descartes)
//
// An interval contains no zero if all b_i > slack. One change of sign from above slack to below -slack means
// exactly one zero. Otherwise the interval is halved (de Casteljau), which sharpens the bounds quadratically.
// `slack` bounds the error of p: the remainder of the series and the rounding of its terms. So a crossing is
// found or excluded, except at a place where |p| <= slack.
// Source: Farin, Curves and Surfaces for CAGD, chapter 6 (Bernstein form, variation diminishing).
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>

namespace signorini::events {

// Polynomials on the unit interval, and proofs that they stay positive.
//
//   p(x) = sum_i b_i B_i,q(x),  0 <= x <= 1:   min b_i <= p(x) <= max b_i
//
// The coefficients bound the polynomial, and halving the interval sharpens the bounds. So the first zero of a
// guard is found or excluded, whatever its signs at both ends.

inline constexpr int max_degree = 5;  // highest degree of a BDF interpolant

[[nodiscard]] constexpr std::size_t z(int i) { return static_cast<std::size_t>(i); }  ///< int as array index

/// Bernstein coefficients of a polynomial of at most degree 5.
struct Bernstein {
  int degree = 0;
  std::array<double, max_degree + 1> b{};

  /// Converts a polynomial with power coefficients: a_0 + a_1 x + ...
  [[nodiscard]] static Bernstein from_powers(int degree, const std::array<double, max_degree + 1>& a);
  [[nodiscard]] double value(double x) const;
  [[nodiscard]] double integral(double x) const;  ///< integral from 0 to x
  [[nodiscard]] Bernstein derivative() const;
  [[nodiscard]] bool positive() const;              ///< all coefficients are > 0
  [[nodiscard]] bool at_least(double level) const;  ///< all coefficients are >= level
  /// Writes the coefficients of this polynomial on [0, x] to `left` and on [x, 1] to `right`.
  void split(double x, Bernstein& left, Bernstein& right) const;
};

/// The smallest x in [0, 1] with p(x) <= 0, to within `resolution`. nullopt: p is positive on [0, 1].
[[nodiscard]] std::optional<double> first_root(const Bernstein& p, double resolution);
/// The smallest x in [0, 1] with p(x) >= level, to within `resolution`. nullopt: p is below the level on [0, 1].
[[nodiscard]] std::optional<double> first_upcrossing(const Bernstein& p, double level, double resolution);

struct FirstRoot {
  enum class Kind {
    none,        ///< p > 0 on [0, 1], up to slack
    crossing,    ///< p > 0 before x, p < 0 after x
    touch,       ///< no proven crossing, but |p| <= slack near x, so p may cross zero there
    not_finite,  ///< coefficients or slack are not finite: no statement is possible
  } kind = Kind::none;
  double x = 0.0;
  std::size_t intervals = 0;  ///< number of examined intervals
};

inline constexpr std::size_t max_root_degree = 32;

/// Finds the first zero on [0, 1]. a: degree + 1 power coefficients, degree <= max_root_degree. Requires p(0) > -slack.
[[nodiscard]] FirstRoot first_root(const double* a, std::size_t degree, double slack);

// Downward zero crossing of a function, bracketed (GSL, Brent's method).
//
//   f(lo) > 0 >= f(hi):   t with f(t) = 0, lo and hi narrowed to `width`

/// The root between lo and hi. Without a downward sign change: lo if f(lo) <= 0, hi if f(lo) and f(hi) are positive. f must be
/// finite on [lo, hi].
[[nodiscard]] double root_between(const std::function<double(double)>& f, double lo, double hi, double width);

}  // namespace signorini::events
