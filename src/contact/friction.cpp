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

}  // namespace signorini
