#include "motion/friction_series.hpp"

#include "contact/slots.hpp"

namespace signorini {

FrictionSeries::FrictionSeries(const Contact& contact, std::size_t index, int s, const Series& series)
    : contact_(&contact), index_(index) {
  friction_.begin(contact, s, slip_rate(0, series));
}

/// Coefficient k of it.
double FrictionSeries::slip_rate(Eigen::Index k, const Series& series) const {
  const ForcingSeries& f = series.forcing;
  const double* u = series.u.col(k + 1).data();
  const double surface = f.surface[index_ * f.count + static_cast<std::size_t>(k) + 1];
  return static_cast<double>(k + 1) / series.scale * (contact_->tangent.dot(u) - surface);
}

double FrictionSeries::known(int k, const Series& series) {
  if (k == 0) return 0.0;
  return friction_.next(slip_rate(k, series), [&](std::size_t i) {
    return series.forces(static_cast<Eigen::Index>(normal_slot(index_)), static_cast<Eigen::Index>(i));
  });
}

}  // namespace signorini
