#include "contact/friction.hpp"

#include <cmath>

namespace signorini {

double sliding_friction(const Contact& contact, double along) {
  if (!contact.friction.stribeck_velocity) return contact.friction.kinetic;
  return contact.friction.kinetic + (contact.friction.static_ - contact.friction.kinetic) *
                                        std::exp(-along / *contact.friction.stribeck_velocity);
}

double sliding_friction_slope(const Contact& contact, double along) {
  if (!contact.friction.stribeck_velocity) return 0.0;
  return (contact.friction.kinetic - sliding_friction(contact, along)) / *contact.friction.stribeck_velocity;
}

Form sliding_row(int s, double f) {
  Form row;
  row.T = 1.0;
  row.N = s * f;
  return row;
}

double sliding_row_value(const Contact& contact, int s, const ContactMotion& m) {
  return m.T + s * sliding_friction(contact, s * m.vt) * m.N;
}

Form sliding_row_tangent(const Contact& contact, int s, const ContactMotion& m) {
  Form row = sliding_row(s, sliding_friction(contact, s * m.vt));
  row.vt = sliding_friction_slope(contact, s * m.vt) * m.N;
  return row;
}

void FrictionRecursion::begin(const Contact& contact, int s, double rate) {
  s_ = s;
  kinetic_ = contact.friction.kinetic;
  velocity_ = *contact.friction.stribeck_velocity;
  const double along = s * rate;
  f_.assign(1, sliding_friction(contact, along));
  exponent_.assign(1, -along / velocity_);
}

/// f and E differ by a factor, but for f_0.
void FrictionRecursion::extend(double rate) {
  const std::size_t k = f_.size();
  exponent_.push_back(-s_ * rate / velocity_);
  double sum = 0.0;
  for (std::size_t j = 1; j <= k; ++j) {
    const double f = j == k ? f_[0] - kinetic_ : f_[k - j];
    sum += static_cast<double>(j) * exponent_[j] * f;
  }
  f_.push_back(sum / static_cast<double>(k));
}

FrictionTangent::FrictionTangent(const Friction& friction, const Friction& by, int s)
    : static_(friction.static_),
      kinetic_(friction.kinetic),
      velocity_(friction.stribeck_velocity.value()),
      by_static_(by.static_),
      by_kinetic_(by.kinetic),
      by_velocity_(by.stribeck_velocity.value_or(0.0)),
      s_(s) {}

void FrictionTangent::extend(double rate, double moved_rate) {
  const std::size_t k = x_.size();
  x_.push_back(s_ * rate);
  y_.push_back((x_[k] * by_velocity_ / velocity_ - s_ * moved_rate) / velocity_);
  if (k == 0) {
    e_.push_back(std::exp(-x_[0] / velocity_));
  } else {
    double sum = 0.0;
    for (std::size_t j = 1; j <= k; ++j) sum -= static_cast<double>(j) * x_[j] * e_[k - j];
    e_.push_back(sum / (velocity_ * static_cast<double>(k)));
  }
  double product = 0.0;
  for (std::size_t j = 0; j <= k; ++j) product += e_[j] * y_[k - j];
  by_p_.push_back((k == 0 ? by_kinetic_ : 0.0) + (by_static_ - by_kinetic_) * e_[k] +
                  (static_ - kinetic_) * product);
}

}  // namespace signorini
