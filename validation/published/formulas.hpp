// formulas.hpp: what the closed forms share, in extended precision.
//
//   m u'' + k u = F, constant F        u(t) = F/k + (u0 - F/k) cos(w t) + v0/w sin(w t),   w^2 = k/m
#pragma once

#include <numbers>

#include "published/figure.hpp"

namespace signorini::published {

constexpr Real pi = std::numbers::pi_v<Real>;

/// A mass and its velocity.
struct Point {
  Real u, v;
};

/// After a time t of free swinging with frequency w about `centre`.
inline Point swing(Point p, Real w, Real centre, Real t) {
  const Real c = std::cos(w * t), s = std::sin(w * t), a = p.u - centre;
  return {centre + a * c + p.v / w * s, -a * w * s + p.v * c};
}

/// After a time t under a constant acceleration.
inline Point fall(Point p, Real a, Real t) { return {p.u + (p.v + a * t / 2) * t, p.v + a * t}; }

/// The zero of f between a and b, where its signs differ, to the last bit. f: Real -> Real.
template <class F>
Real root(F f, Real a, Real b) {
  const bool rising = f(a) < 0;
  for (;;) {
    const Real m = a + (b - a) / 2;
    if (m <= a || m >= b) return m;
    ((f(m) < 0) == rising ? a : b) = m;
  }
}

/// The first zero of f after a, where f has left its sign at a + step/2; looked for in steps.
template <class F>
Real first_root(F f, Real a, Real step) {
  const bool negative = f(a + step / 2) < 0;
  Real b = a + step;
  while ((f(b) < 0) == negative) b += step;
  return root(f, std::max(a + step / 2, b - step), b);
}

}  // namespace signorini::published
