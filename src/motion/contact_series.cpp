#include "motion/contact_series.hpp"

#include <algorithm>
#include <cmath>

namespace signorini::motion {

void ContactSeries::fill(const Contact& contact, std::size_t index, const Series& series,
                         std::size_t degree) {
  degree_ = degree;
  rates_ = unbounded();
  scale_ = series.scale;
  slide_row_ = contact.sliding_point() ? slide : ut;
  values_.resize(fields * stride());
  valid_.fill(false);
  for (const Field field : {N, T, gap, ut, slide}) valid_[field] = true;
  normal_force_given_ = contact.normal_force_given();
  valid_[applied_normal_force_rate] = normal_force_given_;
  double *const g = mutable_coefficients(gap), *const slip = mutable_coefficients(ut),
                *const normal = mutable_coefficients(N), *const tangent = mutable_coefficients(T);
  for (std::size_t k = 0; k < stride(); ++k) {
    g[k] = gap_coefficient(contact, series, k);
    slip[k] = ut_coefficient(contact, index, series, k);
  }
  const auto slots = static_cast<std::size_t>(series.forces.rows());
  const double* forces = series.forces.data();
  for (std::size_t k = 0; k <= degree; ++k, forces += slots) {
    normal[k] = forces[series.layout.normal(index)];
    tangent[k] = forces[series.layout.tangent(index)];
  }
  if (contact.sliding_point()) {
    const double* surface = series.forcing.surface.data() + index * series.forcing.count;
    for (std::size_t k = 0; k <= degree; ++k)
      mutable_coefficients(slide)[k] =
          contact.body_tangent().dot(series.u.col(static_cast<Eigen::Index>(k)).data()) - surface[k];
  }
  if (normal_force_given_) {
    const double* applied = series.forcing.applied_normal_force.data() + index * series.forcing.count;
    for (std::size_t k = 0; k <= degree; ++k)
      mutable_coefficients(applied_normal_force_rate)[k] =
          static_cast<double>(k + 1) / series.scale * applied[k + 1];
  }
}

void ContactSeries::fill_rate(Field field) const {
  const double *const g = coefficients(gap), *const slip = coefficients(ut);
  double* out = values_.data() + row_of(field) * stride();
  for (std::size_t k = 0; k <= degree_; ++k) {
    const double rate = static_cast<double>(k + 1) / scale_;
    const double second = rate * static_cast<double>(k + 2) / scale_;
    out[k] = field == vn   ? rate * g[k + 1]
             : field == vt ? rate * slip[k + 1]
             : field == an ? second * g[k + 2]
                           : 0.0;  // without an applied normal force its rate is zero
  }
  valid_[field] = true;
}

void ContactSeries::bound_rates(double x) {
  constexpr std::array<Field, 4> bounded{N, T, gap, slide};
  std::array<const double*, bounded.size()> a{};
  std::array<double, bounded.size()> rate{};
  for (std::size_t f = 0; f < bounded.size(); ++f) a[f] = coefficients(bounded[f]);
  for (std::size_t k = degree_; k >= 1; --k)  // four independent sums in one loop
    for (std::size_t f = 0; f < bounded.size(); ++f)
      rate[f] = rate[f] * x + static_cast<double>(k) * std::abs(a[f][k]);
  for (std::size_t f = 0; f < bounded.size(); ++f) rates_[bounded[f]] = rate[f];
}

void ContactSeries::combine(const Form& form, double* out) const {
  std::fill(out, out + degree_ + 1, 0.0);
  const auto add = [&](double factor, Field field) {
    if (factor == 0.0) return;
    const double* f = coefficients(field);
    for (std::size_t k = 0; k <= degree_; ++k) out[k] += factor * f[k];
  };
  add(form.N, N);
  add(form.T, T);
  add(form.gap, gap);
  add(form.ut, ut);
  add(form.vn, vn);
  add(form.vt, vt);
  add(form.an, an);
  if (form.applied_normal_force != 0.0 && normal_force_given_) add(-form.applied_normal_force, N);  // N = -q
  add(form.applied_normal_force_rate, applied_normal_force_rate);
  out[0] += form.constant;
}

double ContactSeries::magnitude(const Form& form, double reach) const {
  factor_.resize(degree_ + 1);
  combine(form, factor_.data());
  double sum = 0.0;
  for (std::size_t k = degree_ + 1; k-- > 0;) sum = sum * reach + std::abs(factor_[k]);
  return sum;
}

ContactSeries::GuardSeries ContactSeries::expand(const GuardForm& guard, double reach,
                                                 std::size_t most_degree, double* out) const {
  combine(guard.form, out);
  GuardSeries result{degree_};
  if (guard.is_linear()) return result;
  result.degree = std::min(2 * degree_, most_degree);
  std::fill(out + degree_ + 1, out + result.degree + 1, 0.0);
  other_factor_.resize(degree_ + 1);
  for (const auto& [a, b] : *guard.products) {
    result.terms += magnitude(a, reach) * magnitude(b, reach);
    combine(a, factor_.data());
    combine(b, other_factor_.data());
    for (std::size_t i = 0; i <= degree_; ++i)
      for (std::size_t j = 0; j <= degree_; ++j) {
        const double c = factor_[i] * other_factor_[j];
        if (i + j <= result.degree)
          out[i + j] += c;
        else
          result.truncation_bound += std::abs(c) * std::pow(reach, static_cast<double>(i + j));
      }
  }
  return result;
}

}  // namespace signorini::motion
