#include "contact/friction_limit.hpp"

#include <algorithm>
#include <cmath>

namespace signorini {

double friction_limit(const Friction& f, double x) {
  if (x <= 0.0) return f.static_ * x;
  return (f.kinetic + (f.static_ - f.kinetic) * std::exp(-x / *f.force)) * x;
}

double friction_limit_slope(const Friction& f, double x) {
  if (x <= 0.0) return f.static_;
  const double ratio = x / *f.force;
  return f.kinetic + (f.static_ - f.kinetic) * (1.0 - ratio) * std::exp(-ratio);
}

void set_limit(const Contact& contact, ContactMotion& m) {
  const Friction& f = contact.friction;
  if (!f.by_force()) return;
  m.limit = friction_limit(f, -m.N);
  m.limit_rate = friction_limit_slope(f, -m.N) *
                 (contact.normal_force_given() ? m.pressing_rate : -contact.normal_stiffness * m.vn);
}

LimitSeries::LimitSeries(const Friction& friction, double x0)
    : range_(friction.static_ - friction.kinetic),
      force_(*friction.force),
      slope_(friction_limit_slope(friction, x0)),
      x_{x0},
      e_{std::exp(-std::max(x0, 0.0) / force_)} {}

/// E_k without its term -x_k E_0 / Nc.
double LimitSeries::known_exponential() const {
  const std::size_t k = x_.size();
  double sum = 0.0;
  for (std::size_t j = 1; j < k; ++j) sum += static_cast<double>(j) * x_[j] * e_[k - j];
  return -sum / (force_ * static_cast<double>(k));
}

double LimitSeries::known() const {
  const std::size_t k = x_.size();
  double sum = x_[0] * known_exponential();
  for (std::size_t j = 1; j < k; ++j) sum += x_[j] * e_[k - j];
  return range_ * sum;
}

double LimitSeries::take(double x) {
  const double limit = slope_ * x + known();
  const double e = known_exponential() - x * e_[0] / force_;
  x_.push_back(x);
  e_.push_back(e);
  return limit;
}

}  // namespace signorini
