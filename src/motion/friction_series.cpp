#include "motion/friction_series.hpp"

#include "contact/slots.hpp"

namespace signorini {

FrictionSeries::FrictionSeries(const Contact& contact, std::size_t index, int s, const Series& series)
    : contact_(&contact), index_(index) {
  friction_.begin(contact, s, slip_rate(0, series));
}

/// Coefficient k of it.
double FrictionSeries::slip_rate(std::size_t k, const Series& series) const {
  return static_cast<double>(k + 1) / series.scale * ut_coefficient(*contact_, index_, series, k + 1);
}

double FrictionSeries::known(int k, const Series& series) {
  if (k == 0) return 0.0;
  return friction_.next(slip_rate(static_cast<std::size_t>(k), series), [&](std::size_t i) {
    return series.forces(static_cast<Eigen::Index>(normal_slot(index_)), static_cast<Eigen::Index>(i));
  });
}

}  // namespace signorini
