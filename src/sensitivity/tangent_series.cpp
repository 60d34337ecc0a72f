#include "sensitivity/tangent_series.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"

namespace signorini::sensitivity {
namespace {

// Largest term of a series, relative to the tangent at the beginning; larger terms cost digits of the sum. Chosen value:
// three digits may be lost.
constexpr double max_cancelling = 1e3;
// Limit of the last terms of a series, relative to the tangent. Errors of ten thousand steps accumulate as their square root.
// Chosen value.
constexpr double truncation_error = 1e-14;
constexpr int first_terms = 3;  // the largest of these terms is the size of the tangent at the beginning

std::size_t index_in(const motion::Series& series, std::size_t contact, int order) {
  return contact * series.forcing.count + static_cast<std::size_t>(order);
}

bool any(const Combination& c) {
  return std::any_of(c.terms.begin(), c.terms.end(), [](const auto& term) { return term.second != 0.0; });
}

}  // namespace

SeriesPoint point_at(const Eigen::MatrixXd& u, const Eigen::MatrixXd& forces, double scale,
                     std::size_t degree, double x) {
  SeriesPoint p;
  const Eigen::Index n = u.rows(), m = forces.rows();
  p.u.setZero(n);
  p.v.setZero(n);
  p.a.setZero(n);
  p.forces.setZero(m);
  p.force_rates.setZero(m);
  for (std::size_t k = degree + 1; k-- > 0;) {
    const auto e = static_cast<Eigen::Index>(k);
    const double first = static_cast<double>(k + 1) / scale,
                 second = first * static_cast<double>(k + 2) / scale;
    p.u = p.u * x + u.col(e);
    p.v = p.v * x + first * u.col(e + 1);
    p.a = p.a * x + second * u.col(e + 2);
    p.forces = p.forces * x + forces.col(e);
    if (k < degree) p.force_rates = p.force_rates * x + first * forces.col(e + 1);
  }
  return p;
}

std::vector<SeriesPoint> points_at(const Eigen::MatrixXd& u, const Eigen::MatrixXd& forces, double scale,
                                   std::size_t degree, const std::vector<double>& x,
                                   const std::vector<Eigen::Index>& dofs) {
  const auto terms = static_cast<Eigen::Index>(degree + 1), places = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixXd powers(terms, places), first(terms, places), second(terms, places);
  for (Eigen::Index i = 0; i < places; ++i) {
    double power = 1.0;
    for (Eigen::Index k = 0; k < terms; ++k, power *= x[static_cast<std::size_t>(i)]) {
      powers(k, i) = power;
      first(k, i) = power * static_cast<double>(k + 1) / scale;
      second(k, i) = first(k, i) * static_cast<double>(k + 2) / scale;
    }
  }
  Eigen::MatrixXd some(static_cast<Eigen::Index>(dofs.size()), terms + 2);
  for (std::size_t j = 0; j < dofs.size(); ++j)
    some.row(static_cast<Eigen::Index>(j)) = u.row(dofs[j]).head(terms + 2);
  const Eigen::MatrixXd us = some.leftCols(terms) * powers, as = some.rightCols(terms) * second;
  const Eigen::MatrixXd v = u.middleCols(1, terms) * first, F = forces.leftCols(terms) * powers,
                        rates = forces.middleCols(1, terms - 1) * first.topRows(terms - 1);
  std::vector<SeriesPoint> points;
  points.reserve(x.size());
  for (Eigen::Index i = 0; i < places; ++i) {
    SeriesPoint& p = points.emplace_back();
    p.u.setZero(u.rows());
    p.a.setZero(u.rows());
    for (std::size_t j = 0; j < dofs.size(); ++j) {
      p.u[dofs[j]] = us(static_cast<Eigen::Index>(j), i);
      p.a[dofs[j]] = as(static_cast<Eigen::Index>(j), i);
    }
    p.v = v.col(i);
    p.forces = F.col(i);
    p.force_rates = rates.col(i);
  }
  return points;
}

void recentre(const motion::Series& series, const motion::Forcing& forcing, double x, double part,
              motion::Series& out) {
  // Coefficient j of the new series: part^j sum_k binomial(k, j) x^(k - j) c_k. Force coefficients of orders above
  // series.levels are undefined and not used.
  const Eigen::Index columns = series.u.cols(), known = series.levels + 1;
  Eigen::MatrixXd shift = Eigen::MatrixXd::Zero(columns, columns);
  double power = 1.0;
  for (Eigen::Index j = 0; j < columns; ++j, power *= part) {
    double term = power;  // binomial(j, j)
    for (Eigen::Index k = j; k < columns; ++k) {
      shift(k, j) = term;
      term *= x * static_cast<double>(k + 1) / static_cast<double>(k + 1 - j);
    }
  }
  out.t = series.t + series.scale * x;
  out.scale = series.scale * part;
  out.levels = series.levels;
  out.u.noalias() = series.u * shift;
  out.forces.noalias() = series.forces.leftCols(known) * shift.topLeftCorner(known, known);
  forcing.expand(out.t, out.scale, static_cast<std::size_t>(columns), out.forcing);
}

TangentSeries::TangentSeries(const Model& model, const linear::SystemMatrices& structure,
                             const ModelDerivative& derivative, double size)
    : model_(model),
      structure_(structure),
      derivative_(derivative),
      massless_(linear::has_massless(model)),
      changes_matrices_(
          derivative.mass.nonZeros() + derivative.damping.nonZeros() + derivative.stiffness.nonZeros() > 0),
      forms_(std::any_of(derivative.contacts.begin(), derivative.contacts.end(),
                         [](const ContactRates& c) { return any(c.normal) || any(c.tangent); })),
      x_(static_cast<std::size_t>(model.size() + model.force_count())),
      work_(x_.size()),
      known_u_(static_cast<std::size_t>(model.size())),
      known_v_(known_u_.size()) {
  zero_limit_ = rounding::eps / size;
  for (const Dof& dof : model.dofs)
    scales_.push_back(1.0 / (dof.rotation ? model.scales.rotation : model.scales.displacement));
}

void TangentSeries::begin(const motion::StateSystem& system, const motion::Series& motion,
                          const ForcingRates& forcing, const Tangent& start) {
  system_ = &system;
  motion_ = &motion;
  start_ = &start;
  scale_ = motion.scale;
  levels_ = -1;
  constexpr int columns = max_tangent_levels + 3;
  u_.setZero(model_.size(), columns);
  forces_.setZero(model_.force_count(), columns);
  forcing.expand(motion.t, motion.scale, motion.forcing.count, forcing_);
  friction_.clear();
  for (const std::size_t c : system.factorised().rate_dependent)
    friction_.emplace_back(
        c, contact::FrictionTangent(model_.contacts[c].friction, derivative_.contacts[c].friction,
                                    slip_sign(system.states()[c].state)));
  u_.col(0) = start.u;
  for (Eigen::Index i = 0; i < start.u.size(); ++i)
    if (system.kinds()[static_cast<std::size_t>(i)] == linear::DofKind::massive)
      u_(i, 1) = scale_ * start.v[i];
}

/// The largest entry of x; rotations and displacements are relative to the scales of the scene.
double TangentSeries::size_of(const Eigen::Ref<const Vector>& x) const {
  double size = 0.0;
  for (std::size_t i = 0; i < scales_.size(); ++i)
    size = std::max(size, scales_[i] * std::abs(x[static_cast<Eigen::Index>(i)]));
  return size;
}

bool TangentSeries::expand(const motion::StateSystem& system, const motion::Series& motion,
                           const ForcingRates& forcing, const Tangent& start, double x, int levels) {
  begin(system, motion, forcing, start);
  // Friction by slip rate needs all levels of the slip rate, and velocities to their own digits: an omitted term of w
  // is greater in w' by its degree over the angle of the part.
  for (int k = 0; k <= (friction_.empty() ? std::min(levels, motion.levels) : motion.levels); ++k) level(k);
  const double angle = friction_.empty()
                           ? 1.0
                           : std::min(1.0, x * scale_ * model_.scales.velocity / model_.scales.displacement);
  double first = 0.0, greatest = 0.0, power = 1.0, rounded = 0.0, last = 0.0;
  int checked = 0;
  for (;; level(levels_ + 1)) {
    const int complete = levels_ - late();
    for (; checked <= complete + 2; ++checked, power *= x) {
      const double size = size_of(u_.col(checked)) * power;
      if (!std::isfinite(size)) return false;
      (checked < first_terms ? first : greatest) = std::max(checked < first_terms ? first : greatest, size);
      // Coefficient k results from k/2 solves, each with a relative rounding error of about 4 eps.
      rounded += 2.0 * static_cast<double>(checked + 1) * size;
    }
    last = std::max(size_of(u_.col(complete + 2)), size_of(u_.col(complete + 1)) / x) * power / x;
    if (last <= angle * (truncation_error * std::max(first, greatest) + zero_limit_)) break;
    if (levels_ == max_tangent_levels) return false;
  }
  // In velocities an omitted term is multiplied by its degree.
  const double size = first > 0.0 ? first : greatest;
  error_ = size > 0.0 ? (rounding::eps * rounded + static_cast<double>(levels_) * last / angle) / size : 0.0;
  if (!friction_.empty() && size > 0.0) error_ += friction_error(x, size);
  if (greatest <= max_cancelling * (first + zero_limit_)) return true;
  return greatest <= max_cancelling * size_of(at(x).u);  // the tangent may start from zero
}

void TangentSeries::expand_to(const motion::StateSystem& system, const motion::Series& motion,
                              const ForcingRates& forcing, const Tangent& start, int levels) {
  begin(system, motion, forcing, start);
  for (int k = 0; k <= levels; ++k) level(k);
}

/// Adds the source terms of the parameter in the equations of motion at order k.
void TangentSeries::add_sources(int k) {
  if (forcing_.loaded)
    for (std::size_t i = 0; i < known_u_.size(); ++i) x_[i] += forcing_.load(static_cast<Eigen::Index>(i), k);
  const double to_velocity = (k + 1) / scale_, to_acceleration = to_velocity * (k + 2) / scale_;
  if (changes_matrices_) {
    Eigen::Map<Vector> r(x_.data(), model_.size());
    if (derivative_.mass.nonZeros() > 0) r -= derivative_.mass * (to_acceleration * motion_->u.col(k + 2));
    if (derivative_.damping.nonZeros() > 0) r -= derivative_.damping * (to_velocity * motion_->u.col(k + 1));
    if (derivative_.stiffness.nonZeros() > 0) r -= derivative_.stiffness * motion_->u.col(k);
  }
  if (!forms_) return;
  double* const x = x_.data();
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    derivative_.contacts[c].normal.add_to(
        x, -motion_->forces(static_cast<Eigen::Index>(model_.layout.normal(c)), k));
    derivative_.contacts[c].tangent.add_to(
        x, -motion_->forces(static_cast<Eigen::Index>(model_.layout.tangent(c)), k));
  }
}

/// Computes the right-hand sides of the contacts' rows at order k.
void TangentSeries::add_rows(int k) {
  const linear::Unknowns& at = system_->unknowns();
  const motion::Series& s = *motion_;
  const bool source = k <= s.levels;
  const double to_velocity = (k + 1) / scale_, to_acceleration = to_velocity * (k + 2) / scale_;
  for (std::size_t c = 0; c < at.layout.contacts(); ++c) {
    const Contact& contact = model_.contacts[c];
    const ContactState& state = system_->states()[c];
    const Form &normal = system_->rows()[c].normal, &tangent = system_->rows()[c].tangent;
    double r = 0.0, q = 0.0;
    if (normal.gap != 0.0) r += normal.gap * contact.normal.dot(known_u_.data());
    if (normal.vn != 0.0) r += normal.vn * contact.normal.dot(known_v_.data());
    if (tangent.ut != 0.0) q += tangent.ut * contact.tangent.dot(known_u_.data());
    if (tangent.vt != 0.0) q += tangent.vt * contact.tangent.dot(known_v_.data());
    if (source) {
      const ContactRates& rates = derivative_.contacts[c];
      const auto u = s.u.col(k), v = s.u.col(k + 1), a = s.u.col(k + 2);
      const std::size_t f = index_in(s, c, k);
      ContactMotion m;
      m.N = s.forces(static_cast<Eigen::Index>(model_.layout.normal(c)), k);
      m.T = s.forces(static_cast<Eigen::Index>(model_.layout.tangent(c)), k);
      m.gap = motion::gap_coefficient(contact, s, static_cast<std::size_t>(k));
      m.ut = motion::ut_coefficient(contact, c, s, static_cast<std::size_t>(k));
      m.vn = to_velocity * contact.normal.dot(v);
      m.vt = to_velocity * motion::ut_coefficient(contact, c, s, static_cast<std::size_t>(k) + 1);
      m.an = to_acceleration * contact.normal.dot(a);
      m.at = to_acceleration * motion::ut_coefficient(contact, c, s, static_cast<std::size_t>(k) + 2);
      m.applied_normal_force = s.forcing.applied_normal_force[f];
      m.applied_normal_force_rate = to_velocity * s.forcing.applied_normal_force[f + 1];
      const Rows& row_rates = rates.rows[index_of(state.state)];
      r += row_rates.normal.rate(m);
      if (!contact::slips_nonlinearly(contact, state.state)) q += row_rates.tangent.rate(m);
      const std::size_t p = c * forcing_.count + static_cast<std::size_t>(k);
      const double* surface = forcing_.surface.data() + p;
      r += normal.gap * rates.normal.dot(u) + normal.vn * to_velocity * rates.normal.dot(v) +
           normal.an * to_acceleration * rates.normal.dot(a) +
           normal.applied_normal_force * forcing_.applied_normal_force[p];
      q += tangent.ut * (rates.tangent.dot(u) - surface[0]) +
           tangent.vt * to_velocity * (rates.tangent.dot(v) - surface[1]) +
           tangent.at * to_acceleration * (rates.tangent.dot(a) - surface[2]);
      if (k == 0) {
        r += row_rates.normal.constant + normal.gap * rates.gap;
        q += row_rates.tangent.constant;
        if (state.state == State::stick && contact.tangential_stiffness)
          q += rates.tangential_stiffness * state.anchor + *contact.tangential_stiffness * start_->anchors[c];
      }
    }
    x_[at.normal(c)] = -r;
    x_[at.tangent(c)] = -q;
  }
}

/// Coefficient k of the slip rate of contact c, and of its derivative. Terms of the motion beyond its levels are zero.
std::pair<double, double> TangentSeries::slip_rate(std::size_t c, int k) const {
  const double to_velocity = (k + 1) / scale_;
  const std::size_t order = static_cast<std::size_t>(k) + 1;
  double rate = 0.0, moved = model_.contacts[c].tangent.dot(u_.col(k + 1));
  if (k <= motion_->levels) {
    rate = motion::ut_coefficient(model_.contacts[c], c, *motion_, order);
    moved += derivative_.contacts[c].tangent.dot(motion_->u.col(k + 1)) -
             forcing_.surface[c * forcing_.count + order];
  }
  return {to_velocity * rate, to_velocity * moved};
}

/// Change of the velocities up to x by the friction at x that the series do not follow, relative to the tangent, whose
/// displacements have this size. E is computed there from the slip rate.
double TangentSeries::friction_error(double x, double size) {
  std::fill(x_.begin(), x_.end(), 0.0);
  for (const auto& [c, friction] : friction_) {
    const auto n = static_cast<Eigen::Index>(model_.layout.normal(c)),
               t = static_cast<Eigen::Index>(model_.layout.tangent(c));
    double rate = 0.0, moved = 0.0, N = 0.0, N_p = 0.0, T_p = 0.0;
    for (int k = levels_; k >= 0; --k) {
      const auto slip = slip_rate(c, k);
      rate = rate * x + slip.first;
      moved = moved * x + slip.second;
      N = N * x + (k <= motion_->levels ? motion_->forces(n, k) : 0.0);
      N_p = N_p * x + forces_(n, k);
      T_p = T_p * x + forces_(t, k);
    }
    x_[system_->unknowns().tangent(c)] = friction.residual(rate, moved, N, N_p, T_p);
  }
  system_->solve(x_.data(), work_.data());
  double change = 0.0;
  for (std::size_t i = 0; i < scales_.size(); ++i)
    if (system_->kinds()[i] == linear::DofKind::massive)
      change = std::max(change, scales_[i] * std::abs(x_[i]) * x * scale_);
  const double rate = model_.scales.velocity / model_.scales.displacement;
  return change / std::max(rate * size, size_of(u_.col(1)) / scale_);
}

/// Friction that depends on the slip rate.
void TangentSeries::add_friction(int k) {
  for (auto& [contact, friction] : friction_) {
    const auto [rate, moved_rate] = slip_rate(contact, k);
    const auto row = static_cast<Eigen::Index>(model_.layout.normal(contact));
    x_[system_->unknowns().tangent(contact)] -= friction.next(
        rate, moved_rate,
        [&](std::size_t i) {
          const auto at = static_cast<Eigen::Index>(i);
          return at > motion_->levels ? 0.0 : motion_->forces(row, at);
        },
        [&](std::size_t i) { return forces_(row, static_cast<Eigen::Index>(i)); });
  }
}

void TangentSeries::level(int k) {
  const std::size_t n = known_u_.size();
  const double to_velocity = (k + 1) / scale_, to_acceleration = to_velocity * (k + 2) / scale_;
  const std::vector<linear::DofKind>& kinds = system_->kinds();
  for (std::size_t i = 0; i < n; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    known_u_[i] = kinds[i] == linear::DofKind::algebraic ? 0.0 : u_(e, k);
    known_v_[i] = kinds[i] == linear::DofKind::massive ? to_velocity * u_(e, k + 1) : 0.0;
    x_[i] = 0.0;
  }
  for (const linear::UndampedMotion& motion : system_->undamped())
    for (const auto& [dof, factor] : motion.others)
      known_u_[static_cast<std::size_t>(dof)] -= factor * u_(motion.dof, k);
  structure_.subtract_forces(known_v_.data(), known_u_.data(), x_.data());
  if (k <= motion_->levels) add_sources(k);
  add_rows(k);
  add_friction(k);
  system_->solve(x_.data(), work_.data());
  ++solves_;
  for (std::size_t i = 0; i < n; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    if (kinds[i] == linear::DofKind::massive)
      u_(e, k + 2) = x_[i] / to_acceleration;
    else if (kinds[i] == linear::DofKind::damped)
      u_(e, k + 1) = x_[i] / to_velocity;
    else
      u_(e, k) = x_[i];
  }
  for (const linear::UndampedMotion& motion : system_->undamped())
    for (const auto& other : motion.others)
      u_(other.first, k) = known_u_[static_cast<std::size_t>(other.first)];
  for (const linear::UndampedMotion& motion : system_->undamped())
    for (const auto& [dof, factor] : motion.others)
      u_(dof, k) += factor * x_[static_cast<std::size_t>(motion.dof)];
  std::copy(x_.begin() + static_cast<std::ptrdiff_t>(n), x_.end(), forces_.col(k).data());
  levels_ = k;
}

SeriesPoint TangentSeries::at(double x) const {
  return point_at(u_, forces_, scale_, static_cast<std::size_t>(std::max(levels_ - late(), 0)), x);
}

std::vector<SeriesPoint> TangentSeries::at(const std::vector<double>& x,
                                           const std::vector<Eigen::Index>& dofs) const {
  return points_at(u_, forces_, scale_, static_cast<std::size_t>(std::max(levels_ - late(), 0)), x, dofs);
}

}  // namespace signorini::sensitivity
