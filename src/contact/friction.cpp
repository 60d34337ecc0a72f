#include "contact/friction.hpp"

#include <cmath>

namespace signorini {
namespace {

/// E_k from E_0 ... E_(k-1) and g_0 ... g_k; E = exp(g) times a constant.
double next_of_exponential(const std::vector<double>& g, const std::vector<double>& e) {
  const std::size_t k = e.size();
  double sum = 0.0;
  for (std::size_t j = 1; j <= k; ++j) sum += static_cast<double>(j) * g[j] * e[k - j];
  return sum / static_cast<double>(k);
}

}  // namespace

double sliding_friction(const Contact& contact, double along) {
  const Friction& f = contact.friction;
  if (!f.varies()) return f.kinetic;
  // Below zero slip rate, rising friction continues as a straight line: the exponential would grow without bound there.
  if (f.rises() && along < 0.0) return f.static_ + (f.kinetic - f.static_) * along / f.rate_of_change();
  return f.kinetic + (f.static_ - f.kinetic) * std::exp(-along / f.rate_of_change());
}

double sliding_friction_slope(const Contact& contact, double along) {
  const Friction& f = contact.friction;
  if (!f.varies()) return 0.0;
  if (f.rises() && along < 0.0) return (f.kinetic - f.static_) / f.rate_of_change();
  return (f.kinetic - sliding_friction(contact, along)) / f.rate_of_change();
}

Form sliding_row(int s, double f) {
  Form row;
  row.T = 1.0;
  row.N = s * f;
  return row;
}

double sliding_row_value(const Contact& contact, int s, const ContactMotion& m) {
  if (contact.friction.by_force()) return m.T - s * friction_limit(contact.friction, -m.N);
  return m.T + s * sliding_friction(contact, s * m.vt) * m.N;
}

Form sliding_row_tangent(const Contact& contact, int s, const ContactMotion& m) {
  if (contact.friction.by_force()) return sliding_row(s, friction_limit_slope(contact.friction, -m.N));
  Form row = sliding_row(s, sliding_friction(contact, s * m.vt));
  row.vt = sliding_friction_slope(contact, s * m.vt) * m.N;
  return row;
}

void FrictionRecursion::begin(const Contact& contact, int s, double rate) {
  s_ = s;
  velocity_ = contact.friction.rate_of_change();
  const double along = s * rate;
  first_ = sliding_friction(contact, along);
  varying_.assign(1, first_ - contact.friction.kinetic);
  exponent_.assign(1, -along / velocity_);
}

void FrictionRecursion::take_rate(double rate) {
  exponent_.pop_back();
  varying_.pop_back();
  extend(rate);
}

void FrictionRecursion::extend(double rate) {
  exponent_.push_back(-s_ * rate / velocity_);
  varying_.push_back(next_of_exponential(exponent_, varying_));
}

FrictionTangent::FrictionTangent(const Friction& friction, const Friction& by, int s)
    : static_(friction.static_),
      kinetic_(friction.kinetic),
      velocity_(friction.rate_of_change()),
      by_static_(by.static_),
      by_kinetic_(by.kinetic),
      by_velocity_((friction.rises() ? by.velocity : by.stribeck_velocity).value_or(0.0)),
      s_(s) {}

void FrictionTangent::extend(double rate, double moved_rate) {
  const std::size_t k = e_.size();
  const double x = s_ * rate;
  exponent_.push_back(-x / velocity_);
  y_.push_back((x * by_velocity_ / velocity_ - s_ * moved_rate) / velocity_);
  e_.push_back(k == 0 ? std::exp(exponent_[0]) : next_of_exponential(exponent_, e_));
  double product = 0.0;
  for (std::size_t j = 0; j <= k; ++j) product += e_[j] * y_[k - j];
  by_p_.push_back((k == 0 ? by_kinetic_ : 0.0) + (by_static_ - by_kinetic_) * e_[k] +
                  (static_ - kinetic_) * product);
}

}  // namespace signorini
