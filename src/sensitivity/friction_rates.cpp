#include "sensitivity/friction_rates.hpp"

#include <cmath>

#include "contact/slots.hpp"

namespace signorini {

FrictionRates::FrictionRates(const Contact& contact, const ContactRates& rates, std::size_t index, int s,
                             const Series& motion)
    : contact_(&contact),
      motion_(&motion),
      index_(index),
      s_(s),
      f_{contact.friction.static_, contact.friction.kinetic, *contact.friction.stribeck_velocity},
      rates_{rates.static_friction, rates.kinetic_friction, rates.stribeck_velocity} {}

/// Of the motion; what it left out is nothing.
double FrictionRates::normal(std::size_t i) const {
  if (static_cast<int>(i) > motion_->levels) return 0.0;
  return motion_->forces(static_cast<Eigen::Index>(normal_slot(index_)), static_cast<Eigen::Index>(i));
}

void FrictionRates::extend(int k, double slip) {
  const auto level = static_cast<std::size_t>(k);
  double x = 0.0;
  if (k <= motion_->levels)
    x = s_ * (k + 1) / motion_->scale * ut_coefficient(*contact_, index_, *motion_, level + 1);
  x_.push_back(x);
  y_.push_back((x * rates_.velocity / f_.velocity - s_ * slip) / f_.velocity);
  if (k == 0) {
    e_.push_back(std::exp(-x / f_.velocity));
  } else {  // k E_k = sum_j j g_j E_(k-j),  g = -x/v
    double sum = 0.0;
    for (std::size_t j = 1; j <= level; ++j) sum -= static_cast<double>(j) * x_[j] * e_[level - j];
    e_.push_back(sum / (f_.velocity * k));
  }
  double product = 0.0;
  for (std::size_t j = 0; j <= level; ++j) product += e_[j] * y_[level - j];
  by_p_.push_back((k == 0 ? rates_.kinetic : 0.0) + (rates_.static_ - rates_.kinetic) * e_[level] +
                  (f_.static_ - f_.kinetic) * product);
}

}  // namespace signorini
