#include "base/curves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/rounding.hpp"

namespace signorini::base {
namespace {

/// Coefficients a_0, a_1, ... of the polynomial a_0 + a_1 y + ..., where y = 2x - 1 is in [-1, 1].
using Powers = std::array<double, PolynomialInterpolation::max_points>;

/// Coefficients of the interpolating polynomial, from Newton's divided differences.
Powers powers_of(const PolynomialInterpolation::Values& f, std::size_t n) {
  PolynomialInterpolation::Values y{}, d = f;
  for (std::size_t i = 0; i < n; ++i) y[i] = 2.0 * PolynomialInterpolation::point(n, i) - 1.0;
  for (std::size_t k = 1; k < n; ++k)
    for (std::size_t i = n - 1; i >= k; --i) d[i] = (d[i] - d[i - 1]) / (y[i] - y[i - k]);
  Powers a{};
  for (std::size_t k = n; k-- > 0;) {  // a <- a (y - y_k) + d_k
    for (std::size_t i = n - 1; i > 0; --i) a[i] = a[i - 1] - y[k] * a[i];
    a[0] = d[k] - y[k] * a[0];
  }
  return a;
}

double value(const Powers& a, std::size_t degree, double y) {
  double sum = a[degree];
  for (std::size_t i = degree; i-- > 0;) sum = sum * y + a[i];
  return sum;
}

struct Roots {
  std::array<double, PolynomialInterpolation::max_points> at{};
  std::size_t count = 0;
};

/// Positions of all sign changes of the polynomial in (-1, 1), ascending.
Roots roots_of(const Powers& a, std::size_t degree) {
  Roots roots;
  if (degree == 0) return roots;
  Powers slope{};
  for (std::size_t i = 0; i < degree; ++i) slope[i] = static_cast<double>(i + 1) * a[i + 1];
  const Roots turns = roots_of(slope, degree - 1);
  double left = -1.0, at_left = value(a, degree, left);
  for (std::size_t i = 0; i <= turns.count; ++i) {
    const double end = i < turns.count ? turns.at[i] : 1.0, at_end = value(a, degree, end);
    if ((at_left > 0.0) != (at_end > 0.0)) {
      double low = left, high = end;
      for (int step = 0; step < 60 && high - low > rounding::few_operations; ++step) {
        const double middle = 0.5 * (low + high);
        ((value(a, degree, middle) > 0.0) == (at_left > 0.0) ? low : high) = middle;
      }
      roots.at[roots.count++] = 0.5 * (low + high);
    }
    left = end;
    at_left = at_end;
  }
  return roots;
}

}  // namespace

double PolynomialInterpolation::point(std::size_t n, std::size_t i) {
  static const auto points = [] {
    std::array<Values, max_points + 1> all{};
    for (std::size_t count = 2; count <= max_points; ++count)
      for (std::size_t j = 0; j < count; ++j) {
        const double part = static_cast<double>(j) / static_cast<double>(count - 1);
        const double s = std::sin(0.5 * std::numbers::pi * part);
        all[count][j] = 2 * j + 1 == count ? 0.5 : s * s;
      }
    return all;
  }();
  return points[n][i];
}

double PolynomialInterpolation::interpolate(const Values& f, std::size_t n, double x) {
  if (n == 1) return f[0];
  double above = 0.0, below = 0.0, sign = 1.0;
  for (std::size_t i = 0; i < n; ++i, sign = -sign) {
    const double off = x - point(n, i);
    if (off == 0.0) return f[i];
    const double w = sign * (i == 0 || i + 1 == n ? 0.5 : 1.0) / off;
    above += w * f[i];
    below += w;
  }
  return above / below;
}

PolynomialInterpolation::Extremes PolynomialInterpolation::extremes(const Values& f, std::size_t n) {
  Extremes e{f[0], f[0], 0.0, 0.0};
  if (n == 1) return e;
  double size = 0.0;
  for (std::size_t i = 0; i < n; ++i) size = std::max(size, std::abs(f[i]));
  const double tie = rounding::few_operations * size;
  const auto see = [&](double x, double y) {
    if (y > e.greatest + tie) e.greatest = y, e.at_greatest = x;
    if (y < e.least - tie) e.least = y, e.at_least = x;
  };
  Powers slope{};
  const Powers a = powers_of(f, n);
  for (std::size_t i = 0; i + 1 < n; ++i) slope[i] = static_cast<double>(i + 1) * a[i + 1];
  const Roots roots = roots_of(slope, n - 2);
  for (std::size_t i = 0; i < roots.count; ++i) {
    const double x = 0.5 * (roots.at[i] + 1.0);
    see(x, interpolate(f, n, x));
  }
  see(1.0, f[n - 1]);
  return e;
}

}  // namespace signorini::base
