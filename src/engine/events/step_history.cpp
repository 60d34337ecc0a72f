#include "engine/events/step_history.hpp"

#include <algorithm>
#include <cmath>

#include "base/simd.hpp"

namespace signorini::events {
namespace {

using Kept = std::array<const double*, max_degree + 1>;  // [b]: values of all scalars b steps back

template <class T>
[[gnu::always_inline]] inline void look_at(const Kept& rows, int order, double twice_bend, int degree,
                                           const double* weights, std::size_t s, double* bent, double* mean) {
  const T last = base::lanes_at<T>(rows[0] + s).v;
  T change{}, sum{};
  for (int b = 1; b <= order; ++b) {
    const T off = base::lanes_at<T>(rows[z(b)] + s).v - last, far = off < 0.0 ? -off : off;
    change = change < far ? far : change;
  }
  for (int b = 0; b <= degree; ++b) sum += weights[b] * base::lanes_at<T>(rows[z(b)] + s).v;
  base::lanes_at<T>(bent + s).v = twice_bend * change;
  base::lanes_at<T>(mean + s).v = sum;
}

/// Computes for n scalars: bent = twice_bend max_b |f_b - f_0|,  mean = sum_b weight_b f_b.
SIGNORINI_WIDE_LANES void variations_and_means(const Kept& rows, int order, double twice_bend, int degree,
                                               const double* weights, std::size_t n, double* bent,
                                               double* mean) {
  std::size_t s = 0;
  for (; s + 3 < n; s += 4) look_at<base::Double4>(rows, order, twice_bend, degree, weights, s, bent, mean);
  for (; s < n; ++s) look_at<double>(rows, order, twice_bend, degree, weights, s, bent, mean);
}

}  // namespace

double* StepHistory::restart(double t) {
  filled_ = 1;
  for (int b = 0; b <= max_degree; ++b) slot_[z(b)] = b;
  times_[0] = t;
  return values_.data();
}

double* StepHistory::push(double t, double length) {
  std::rotate(slot_.begin(), slot_.end() - 1, slot_.end());
  std::rotate(times_.begin(), times_.end() - 1, times_.end());
  std::rotate(lengths_.begin(), lengths_.end() - 1, lengths_.end());
  times_[0] = t;
  lengths_[0] = length;
  filled_ = std::min(filled_ + 1, max_degree + 1);
  return values_.data() + z(slot_[0]) * scalars_;
}

void StepHistory::prepare(int order) {
  prepare(powers_basis_, filled_ - 1);
  shares_basis_ = order >= powers_basis_.degree;
  if (!shares_basis_) prepare(order_basis_, order);
  Kept rows{};
  for (int b = 0; b < filled_; ++b) rows[z(b)] = values_.data() + z(slot_[z(b)]) * scalars_;
  variations_and_means(rows, order_basis().degree, 2.0 * order_basis().variation_factor, powers_basis_.degree,
                       powers_basis_.integral.data(), scalars_, variation_bounds_.data(), mean_.data());
}

void StepHistory::prepare(Basis& basis, int degree) const {
  // Lagrange polynomials on the nodes x_b, as power coefficients, then as Bernstein coefficients.
  std::array<double, max_degree + 1> x{1.0};
  for (int b = 1; b <= degree; ++b) x[z(b)] = x[z(b - 1)] - lengths_[z(b - 1)] / lengths_[0];
  if (degree == basis.degree && x == basis.nodes) return;
  basis.nodes = x;
  basis.degree = degree;
  for (int b = 0; b <= degree; ++b) {
    std::array<double, max_degree + 1> a{1.0};
    int reached = 0;
    double denominator = 1.0;
    for (int j = 0; j <= degree; ++j) {
      if (j == b) continue;
      for (int i = ++reached; i > 0; --i) a[z(i)] = a[z(i - 1)] - x[z(j)] * a[z(i)];
      a[0] *= -x[z(j)];
      denominator *= x[z(b)] - x[z(j)];
    }
    for (double& c : a) c /= denominator;
    const Bernstein lagrange = Bernstein::from_powers(degree, a);
    basis.integral[z(b)] = 0.0;
    for (int i = 0; i <= degree; ++i) {
      basis.to_bernstein[z(i)][z(b)] = lagrange.b[z(i)];
      basis.integral[z(b)] += lagrange.b[z(i)] / (degree + 1);
    }
  }
  basis.variation_factor = 0.0;
  for (int i = 0; i <= degree; ++i) {
    double sum = 0.0;
    for (int b = 1; b <= degree; ++b) sum += std::abs(basis.to_bernstein[z(i)][z(b)]);
    basis.variation_factor = std::max(basis.variation_factor, sum);
  }
  basis.monotone_factor = 0.0;
  for (int i = 0; i < degree; ++i) {
    double sum = 0.0;
    for (int b = 2; b <= degree; ++b)
      sum += std::abs(basis.to_bernstein[z(i + 1)][z(b)] - basis.to_bernstein[z(i)][z(b)]);
    basis.monotone_factor = std::max(basis.monotone_factor, 2.0 * degree * sum);
  }
}

bool StepHistory::clearly_monotone(std::size_t i) const {
  const Basis& basis = order_basis();
  const double last = value(0, i), rise = last - value(1, i);
  double off = 0.0;
  for (int b = 2; b <= basis.degree; ++b)
    off = std::max(off, std::abs(value(b, i) - last - rise * (basis.nodes[z(b)] - 1.0)));
  return basis.monotone_factor * off <= std::abs(rise);
}

Bernstein StepHistory::interpolant(const Basis& basis, std::size_t s) const {
  Bernstein p;
  p.degree = basis.degree;
  for (int i = 0; i <= basis.degree; ++i)
    for (int b = 0; b <= basis.degree; ++b) p.b[z(i)] += basis.to_bernstein[z(i)][z(b)] * value(b, s);
  return p;
}

std::optional<GuardCubic::ZeroCrossing> GuardCubic::cubic_root() const {
  const double b = 3.0 * (g1 - g0) - 2.0 * r0 - r1, c = 2.0 * (g0 - g1) + r0 + r1;
  double lo = 0.0, hi = 1.0, x = linear_root(), slope = 0.0;
  constexpr int most_steps = 8;  // number of Newton steps in the bracket; enough if started at linear_root()
  for (int i = 0; i < most_steps; ++i) {
    const double value = g0 + x * (r0 + x * (b + x * c));
    slope = r0 + x * (2.0 * b + 3.0 * x * c);
    (value > 0.0 ? lo : hi) = x;
    const double next = x - value / slope;
    x = next >= lo && next <= hi ? next : 0.5 * (lo + hi);
  }
  if (!(x > 0.0 && x < 1.0) || !(slope < 0.0)) return std::nullopt;
  return ZeroCrossing{x, slope};
}

std::optional<double> GuardCubic::interior_minimum() const {
  // g0 and g1 are positive. If the inner Bernstein coefficients are also positive, the whole cubic is positive.
  if (g0 + r0 / 3.0 > 0.0 && g1 - r1 / 3.0 > 0.0) return std::nullopt;
  const double b = 3.0 * (g1 - g0) - 2.0 * r0 - r1, c = 2.0 * (g0 - g1) + r0 + r1;
  // Root of p' = r0 + 2 b x + 3 c x^2 with p'' > 0, by a formula without cancellation or division by c = 0.
  const double root = b * b - 3.0 * c * r0;
  if (!(root > 0.0)) return std::nullopt;
  const double s = std::sqrt(root);
  const double x = b > 0.0 ? -r0 / (b + s) : (s - b) / (3.0 * c);
  if (!(x > 0.0 && x < 1.0) || g0 + x * (r0 + x * (b + x * c)) > 0.0) return std::nullopt;
  return x;
}

void rates_from_values(GuardCubic& path, double h, double before, double h_before) {
  const double slope = path.g1 - path.g0;
  path.r0 = path.r1 = slope;
  if (!(h_before > 0.0)) return;
  const double bend = (slope - (path.g0 - before) * h / h_before) * h / (h + h_before);
  path.r0 -= bend;
  path.r1 += bend;
}

}  // namespace signorini::events
