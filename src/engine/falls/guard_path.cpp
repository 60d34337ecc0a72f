#include "engine/falls/guard_path.hpp"

#include <cmath>

namespace signorini {

std::optional<GuardPath::Fall> GuardPath::fall() const {
  const double b = 3.0 * (g1 - g0) - 2.0 * r0 - r1, c = 2.0 * (g0 - g1) + r0 + r1;
  double lo = 0.0, hi = 1.0, x = linear(), slope = 0.0;
  constexpr int most_steps = 8;  // limit of Newton steps, within the bracket: the first guess needs no more
  for (int i = 0; i < most_steps; ++i) {
    const double value = g0 + x * (r0 + x * (b + x * c));
    slope = r0 + x * (2.0 * b + 3.0 * x * c);
    (value > 0.0 ? lo : hi) = x;
    const double next = x - value / slope;
    x = next >= lo && next <= hi ? next : 0.5 * (lo + hi);
  }
  if (!(x > 0.0 && x < 1.0) || !(slope < 0.0)) return std::nullopt;
  return Fall{x, slope};
}

std::optional<double> GuardPath::dip() const {
  // Bernstein coefficients bound the cubic from below.
  if (g0 + r0 / 3.0 > 0.0 && g1 - r1 / 3.0 > 0.0) return std::nullopt;
  const double b = 3.0 * (g1 - g0) - 2.0 * r0 - r1, c = 2.0 * (g0 - g1) + r0 + r1;
  // p' = r0 + 2 b x + 3 c x^2; the root where p'' > 0, without cancellation or division by c = 0
  const double root = b * b - 3.0 * c * r0;
  if (!(root > 0.0)) return std::nullopt;
  const double s = std::sqrt(root);
  const double x = b > 0.0 ? -r0 / (b + s) : (s - b) / (3.0 * c);
  if (!(x > 0.0 && x < 1.0) || g0 + x * (r0 + x * (b + x * c)) > 0.0) return std::nullopt;
  return x;
}

void rates_from_values(GuardPath& path, double h, double before, double h_before) {
  const double slope = path.g1 - path.g0;
  path.r0 = path.r1 = slope;
  if (!(h_before > 0.0)) return;
  const double bend = (slope - (path.g0 - before) * h / h_before) * h / (h + h_before);
  path.r0 -= bend;
  path.r1 += bend;
}

}  // namespace signorini
