#include "motion/friction_series.hpp"

#include "contact/law.hpp"

namespace signorini {

FrictionSeries::FrictionSeries(const Contact& contact, std::size_t index, int s, const Series& series)
    : contact_(&contact), index_(index), s_(s) {
  const double along = s * slip_rate(0, series);
  f_.assign(1, sliding_friction(contact, along));
  exponent_.assign(1, -along / *contact.stribeck_velocity);
}

/// Coefficient k of it.
double FrictionSeries::slip_rate(Eigen::Index k, const Series& series) const {
  const ForcingSeries& f = series.forcing;
  const double* u = series.u.col(k + 1).data();
  const double surface = f.surface[index_ * f.count + static_cast<std::size_t>(k) + 1];
  return static_cast<double>(k + 1) / series.scale * (contact_->tangent.dot(u) - surface);
}

double FrictionSeries::known(int order, const Series& series) {
  const auto k = static_cast<std::size_t>(order);
  if (k == 0) return 0.0;
  exponent_.resize(k + 1);
  f_.resize(k + 1);
  exponent_[k] = -s_ * slip_rate(order, series) / *contact_->stribeck_velocity;
  double sum = 0.0;  // f and E differ by a factor, but for f_0
  for (std::size_t j = 1; j <= k; ++j) {
    const double f = j == k ? f_[0] - contact_->kinetic_friction : f_[k - j];
    sum += static_cast<double>(j) * exponent_[j] * f;
  }
  f_[k] = sum / static_cast<double>(k);
  double known = 0.0;
  for (std::size_t j = 1; j <= k; ++j)
    known += f_[j] * series.forces(static_cast<Eigen::Index>(2 * index_), static_cast<Eigen::Index>(k - j));
  return s_ * known;
}

}  // namespace signorini
