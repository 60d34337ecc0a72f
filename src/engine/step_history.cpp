#include "engine/step_history.hpp"

#include <algorithm>
#include <cmath>

namespace signorini {
namespace {
std::size_t z(int i) { return static_cast<std::size_t>(i); }
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
  degree_ = std::min(order, filled_ - 1);
  // Lagrange polynomials on the nodes x_b, as power coefficients, then as Bernstein coefficients.
  std::array<double, max_degree + 1> x{1.0};
  for (int b = 1; b <= degree_; ++b) x[z(b)] = x[z(b - 1)] - lengths_[z(b - 1)] / lengths_[0];
  if (degree_ == nodes_degree_ && x == nodes_) return;
  nodes_ = x;
  nodes_degree_ = degree_;
  for (int b = 0; b <= degree_; ++b) {
    std::array<double, max_degree + 1> a{1.0};
    int degree = 0;
    double denominator = 1.0;
    for (int j = 0; j <= degree_; ++j) {
      if (j == b) continue;
      for (int i = ++degree; i > 0; --i) a[z(i)] = a[z(i - 1)] - x[z(j)] * a[z(i)];
      a[0] *= -x[z(j)];
      denominator *= x[z(b)] - x[z(j)];
    }
    for (double& c : a) c /= denominator;
    const Bernstein lagrange = Bernstein::from_powers(degree_, a);
    integral_[z(b)] = 0.0;
    for (int i = 0; i <= degree_; ++i) {
      to_bernstein_[z(i)][z(b)] = lagrange.b[z(i)];
      integral_[z(b)] += lagrange.b[z(i)] / (degree_ + 1);
    }
  }
  bend_ = 0.0;
  for (int i = 0; i <= degree_; ++i) {
    double sum = 0.0;
    for (int b = 1; b <= degree_; ++b) sum += std::abs(to_bernstein_[z(i)][z(b)]);
    bend_ = std::max(bend_, sum);
  }
}

bool StepHistory::clearly_positive(std::size_t s) const {
  const double last = value(0, s);
  double change = 0.0;
  for (int b = 1; b <= degree_; ++b) change = std::max(change, std::abs(value(b, s) - last));
  // Twice, so that the rounding of the sums has no part in it.
  return last > 2.0 * bend_ * change;
}

double StepHistory::integral(std::size_t s) const {
  double sum = 0.0;
  for (int b = 0; b <= degree_; ++b) sum += integral_[z(b)] * value(b, s);
  return (times_[0] - times_[1]) * sum;
}

Bernstein StepHistory::polynomial(std::size_t s) const {
  Bernstein p;
  p.degree = degree_;
  for (int i = 0; i <= degree_; ++i)
    for (int b = 0; b <= degree_; ++b) p.b[z(i)] += to_bernstein_[z(i)][z(b)] * value(b, s);
  return p;
}

}  // namespace signorini
