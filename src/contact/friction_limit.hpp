// friction_limit.hpp: friction whose coefficient depends on the normal force.
//
//   |T| <= F in stick,  T = s F in slip,  F(x) = f(x) x,
//   f(x) = fh + (fl - fh) exp(-x / Nc),  x = |N|              fl, fh: for light and for heavy loads, Nc: `force`
//   F'(x) = fh + (fl - fh) (1 - x / Nc) exp(-x / Nc)
//
// F is smooth, F(0) = 0 and F'(0) = fl; below zero it continues as a straight line, so that a root finder may evaluate
// it slightly beyond a separation. Along a series of x, with E = exp(-x / Nc):
//   k E_k = -(1 / Nc) sum_(j = 1..k) j x_j E_(k-j),   F_k = fh x_k + (fl - fh) sum_(j = 0..k) x_j E_(k-j)
// F'(x_0) x_k is the part of F_k that contains x_k. Units: F, x and Nc are forces, f is dimensionless.
#pragma once

#include <vector>

#include "signorini/contact.hpp"

namespace signorini {

/// F at the compression x = -N, and its slope, for friction that depends on N.
[[nodiscard]] double friction_limit(const Friction& friction, double x);
[[nodiscard]] double friction_limit_slope(const Friction& friction, double x);

/// Sets F and its rate in the motion of a closed contact, from N, g' and q; no effect if friction does not depend on N.
void set_limit(const Contact& contact, ContactMotion& m);

/// F along a series of x, one coefficient after the other.
class LimitSeries {
 public:
  LimitSeries(const Friction& friction, double x0);

  /// Slope F'(x_0).
  [[nodiscard]] double slope() const { return slope_; }
  /// F_k without F'(x_0) x_k for the next level k; it is known before x_k.
  [[nodiscard]] double known() const;
  /// Takes x_k, for k = 1, 2, ...; returns F_k.
  double take(double x);

 private:
  [[nodiscard]] double known_exponential() const;

  double range_, force_;  // fl - fh, Nc
  double slope_;
  std::vector<double> x_, e_;
};

}  // namespace signorini
