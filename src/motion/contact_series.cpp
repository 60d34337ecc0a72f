#include "motion/contact_series.hpp"

#include <algorithm>
#include <cmath>

namespace signorini {

void ContactSeries::fill(const Contact& contact, std::size_t index, const Series& series,
                         std::size_t degree) {
  degree_ = degree;
  rates_ = unbounded();
  values_.resize(fields * (degree + 1));
  normal_.resize(degree + 3);
  tangent_.resize(degree + 3);
  scale_ = series.scale;
  const double* surface = series.forcing.surface.data() + index * series.forcing.count;
  const double* pressing = series.forcing.pressing.data() + index * series.forcing.count;
  for (std::size_t k = 0; k < degree + 3; ++k) {
    normal_[k] = gap_coefficient(contact, series, k);
    tangent_[k] = ut_coefficient(contact, index, series, k);
  }
  there_.fill(false);
  for (const Field field : {N, T, gap, ut, slide}) there_[field] = true;
  there_[pressing_rate] = contact.is_pressed();
  for (std::size_t k = 0; k <= degree; ++k) {
    const auto e = static_cast<Eigen::Index>(k);
    place(N)[k] = series.forces(static_cast<Eigen::Index>(normal_slot(index)), e);
    place(T)[k] = series.forces(static_cast<Eigen::Index>(tangent_slot(index)), e);
    place(gap)[k] = normal_[k];
    place(ut)[k] = tangent_[k];
    place(slide)[k] =
        contact.shear ? contact.shear->body.dot(series.u.col(e).data()) - surface[k] : tangent_[k];
    if (there_[pressing_rate])
      place(pressing_rate)[k] = static_cast<double>(k + 1) / series.scale * pressing[k + 1];
  }
}

void ContactSeries::derive(Field field) const {
  double* out = values_.data() + field * (degree_ + 1);
  for (std::size_t k = 0; k <= degree_; ++k) {
    const double rate = static_cast<double>(k + 1) / scale_;
    const double second = rate * static_cast<double>(k + 2) / scale_;
    out[k] = field == vn   ? rate * normal_[k + 1]
             : field == vt ? rate * tangent_[k + 1]
             : field == an ? second * normal_[k + 2]
                           : 0.0;  // nothing presses
  }
  there_[field] = true;
}

void ContactSeries::bound_rates(double x) {
  for (const Field field : {N, T, gap, slide}) {
    const double* a = of(field);
    double rate = 0.0;
    for (std::size_t k = degree_; k >= 1; --k) rate = rate * x + static_cast<double>(k) * std::abs(a[k]);
    rates_[field] = rate;
  }
}

void ContactSeries::combine(const Form& form, double* out) const {
  std::fill(out, out + degree_ + 1, 0.0);
  const auto add = [&](double factor, Field field) {
    if (factor == 0.0) return;
    const double* f = of(field);
    for (std::size_t k = 0; k <= degree_; ++k) out[k] += factor * f[k];
  };
  add(form.N, N);
  add(form.T, T);
  add(form.gap, gap);
  add(form.ut, ut);
  add(form.vn, vn);
  add(form.vt, vt);
  add(form.an, an);
  add(form.pressing_rate, pressing_rate);
  out[0] += form.constant;
}

}  // namespace signorini
