#include "engine/step_history.hpp"

#include <algorithm>

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

double* StepHistory::push(double t) {
  std::rotate(slot_.begin(), slot_.end() - 1, slot_.end());
  std::rotate(times_.begin(), times_.end() - 1, times_.end());
  times_[0] = t;
  filled_ = std::min(filled_ + 1, max_degree + 1);
  return values_.data() + z(slot_[0]) * scalars_;
}

void StepHistory::prepare(int order) {
  degree_ = std::min(order, filled_ - 1);
  // Lagrange polynomials on the nodes x_b, as power coefficients, then as Bernstein coefficients.
  const double h = times_[0] - times_[1];
  std::array<double, max_degree + 1> x{};
  for (int b = 0; b <= degree_; ++b) x[z(b)] = (times_[z(b)] - times_[1]) / h;
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
      integral_[z(b)] += h * lagrange.b[z(i)] / (degree_ + 1);
    }
  }
}

double StepHistory::integral(std::size_t s) const {
  double sum = 0.0;
  for (int b = 0; b <= degree_; ++b) sum += integral_[z(b)] * value(b, s);
  return sum;
}

Bernstein StepHistory::polynomial(std::size_t s) const {
  Bernstein p;
  p.degree = degree_;
  for (int i = 0; i <= degree_; ++i)
    for (int b = 0; b <= degree_; ++b) p.b[z(i)] += to_bernstein_[z(i)][z(b)] * value(b, s);
  return p;
}

}  // namespace signorini
