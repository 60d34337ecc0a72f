// bernstein.hpp: polynomials on the unit interval, and proofs that they stay positive.
//
//   p(x) = sum_i b_i B_i,q(x),  0 <= x <= 1:   min b_i <= p(x) <= max b_i
//
// The coefficients bound the polynomial and halving the interval sharpens the bounds, so the first zero of a guard is
// found or excluded whatever the signs at the ends.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace signorini {

inline constexpr int max_degree = 5;  // BDF interpolants

[[nodiscard]] constexpr std::size_t z(int i) { return static_cast<std::size_t>(i); }  ///< an index

/// Bernstein coefficients of a polynomial of at most degree 5.
struct Bernstein {
  int degree = 0;
  std::array<double, max_degree + 1> b{};

  /// From power coefficients a_0 + a_1 x + ...
  [[nodiscard]] static Bernstein from_powers(int degree, const std::array<double, max_degree + 1>& a);
  [[nodiscard]] double value(double x) const;
  [[nodiscard]] double integral(double x) const;  ///< from 0 to x
  [[nodiscard]] Bernstein derivative() const;
  [[nodiscard]] bool positive() const;              ///< all coefficients are > 0
  [[nodiscard]] bool at_least(double level) const;  ///< all coefficients are >= level
  /// The same polynomial on [0, x] and on [x, 1].
  void split(double x, Bernstein& left, Bernstein& right) const;
};

/// The smallest x in [0, 1] with p(x) <= 0 to within `resolution`, if any; p is positive before it.
[[nodiscard]] std::optional<double> first_fall(const Bernstein& p, double resolution);
/// The smallest x in [0, 1] with p(x) >= level to within `resolution`, if any.
[[nodiscard]] std::optional<double> first_reach(const Bernstein& p, double level, double resolution);

}  // namespace signorini
