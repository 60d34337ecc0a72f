#include "motion/taylor.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/rounding.hpp"
#include "contact/contact_states.hpp"
#include "contact/curved_surface.hpp"
#include "contact/friction.hpp"
#include "motion/local_derivatives.hpp"

namespace signorini::motion {

FrictionSeries::FrictionSeries(const Contact& contact, std::size_t index, int s, const Form& normal,
                               const Series& series)
    : contact_(&contact), index_(index), sign_(s) {
  if (contact.friction.is_load_dependent()) {
    begin_load_dependent(normal, series);
    return;
  }
  if (contact.sliding_point()) {
    begin_massless(s, normal, series);
    return;
  }
  friction_.begin(contact, s, slip_rate(0, series));
  row_ = contact::sliding_row(s, friction_.first());
}

/// Starts the series for friction that depends on N. N_0 follows from g or q, because all degrees of freedom of such a
/// contact have mass.
void FrictionSeries::begin_load_dependent(const Form& normal, const Series& series) {
  const Friction& friction = contact_->friction;
  const double pressed = -normal_coefficient(*contact_, index_, normal, series, 0);
  limit_.emplace(friction, pressed);
  row_ = contact::sliding_row(sign_, limit_->slope());
  row_.constant = sign_ * (limit_->slope() * pressed - contact::friction_limit(friction, pressed));
}

/// Starts the series for a massless sliding point, whose slip rate follows from the forces of its spring and dashpot.
void FrictionSeries::begin_massless(int s, const Form& normal, const Series& series) {
  const Contact& c = *contact_;
  const ShearElement& element = *c.sliding_point();
  const double *u = series.u.data(), *u1 = u + series.u.rows(), per_time = 1.0 / series.scale;
  const ForcingSeries& f = series.forcing;
  const double length = element.body.dot(u) - c.tangent.dot(u);
  // Velocity of the body relative to the surface, in the direction of slip.
  const double along = s * per_time * (element.body.dot(u1) - f.surface[index_ * f.count + 1]);
  const double pressed = -normal_coefficient(c, index_, normal, series, 0);
  // Time derivative of |N| without the part of a dashpot, which depends on accelerations (is_ambiguous()).
  const double growth = normal.gap * per_time * c.normal.dot(u1) +
                        normal.applied_normal_force * per_time * f.applied_normal_force[index_ * f.count + 1];
  const double pull = s * element.stiffness * length + element.damping * along;
  const double zero =
      rounding::elimination * (std::abs(normal.gap) * (std::abs(c.gap) + c.normal.magnitude(u)) +
                               element.stiffness * (element.body.magnitude(u) + c.tangent.magnitude(u)));
  double rate = 0.0;
  if (pressed <= zero) {  // T and N start from zero together
    constant_ = true;
    if (element.damping > 0.0)
      rate = pull / element.damping;
    else if (growth > 0.0)
      rate = *contact::massless_slip_rate(c.friction, element.stiffness * along, element.stiffness, growth);
    row_ = contact::sliding_row(s, contact::sliding_friction(c, std::max(rate, 0.0)));
    return;
  }
  if (const auto found = contact::massless_slip_rate(c.friction, pull, element.damping, pressed)) {
    rate = *found;
  } else {
    const double greatest = max_rate();
    rate = along - c.friction.kinetic * growth / element.stiffness;
    if (rate >= greatest) {
      constant_ = true;
      row_ = contact::sliding_row(s, contact::sliding_friction(c, rate));
      return;
    }
    ambiguous_ = normal.vn != 0.0;
    rate = greatest;
    jump_ = length - s * contact::sliding_friction(c, rate) * pressed / element.stiffness;
  }
  friction_.begin(c, s, s * rate);
  ContactMotion m;
  m.N = -pressed;
  m.vt = s * rate;
  row_ = contact::sliding_row_tangent(c, s, m);
  row_.constant = -row_.vt * m.vt;
}

double FrictionSeries::max_rate() const { return contact::saturation_rate(contact_->friction); }

void FrictionSeries::follow_quasi_statically() {
  constant_ = true;
  jump_ = 0.0;
  row_ = contact::sliding_row(sign_, contact_->friction.kinetic);
}

/// Coefficient k of the Taylor series of the slip rate.
double FrictionSeries::slip_rate(std::size_t k, const Series& series) const {
  return static_cast<double>(k + 1) / series.scale * ut_coefficient(*contact_, index_, series, k + 1);
}

double FrictionSeries::known(int k, const Series& series) {
  if (k == 0 || constant_) return 0.0;
  const auto level = static_cast<std::size_t>(k);
  if (limit_) {
    if (k > 1)
      limit_->take(-series.forces(static_cast<Eigen::Index>(series.layout.normal(index_)),
                                  static_cast<Eigen::Index>(level - 1)));
    return -sign_ * limit_->known();
  }
  const auto applied = [&](std::size_t i) {
    return series.forces(static_cast<Eigen::Index>(series.layout.normal(index_)),
                         static_cast<Eigen::Index>(i));
  };
  if (!contact_->sliding_point()) return friction_.next(slip_rate(level, series), applied);
  if (k > 1) friction_.take_rate(slip_rate(level - 1, series));
  return friction_.without_rate(applied);
}

double FrictionSeries::reach(std::size_t degree, double x) const {
  return constant_ || limit_ || contact_->sliding_point() ? x : friction_.reach(degree, x);
}

double DataPerturbation::fraction(std::size_t i) {
  std::uint64_t mixed = (static_cast<std::uint64_t>(i) + 1) * 0x9e3779b97f4a7c15u;  // splitmix64
  mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9u;
  mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebu;
  mixed ^= mixed >> 31;
  const double size = 0.5 + 0.5 * rounding::eps * static_cast<double>(mixed >> 12);  // 52 bits
  return (mixed & 1u ? max_roundings : -max_roundings) * rounding::eps * size;
}

Taylor::Taylor(StateSystems& systems)
    : systems_(systems),
      model_(systems.model()),
      structure_(systems.structure()),
      massless_(linear::has_massless(model_)) {
  const auto n = static_cast<std::size_t>(structure_.size);
  const linear::Unknowns unknowns{n, model_.layout};
  x_.resize(unknowns.size());
  work_.resize(unknowns.size());
  known_u_.resize(n);
  known_v_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double mass = model_.mass.coeff(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i));
    mobility_.push_back(mass > 0.0 ? 1.0 / mass : 0.0);
  }
  for (std::size_t c = 0; c < model_.contacts.size(); ++c)
    if (model_.contacts[c].curved_surface()) curved_contacts_.push_back(c);
}

/// Prepares all contacts with varying friction; their initial friction coefficients enter the matrix of the series.
void Taylor::start_friction(const Forcing& forcing, Series& series) {
  friction_.clear();
  const std::vector<std::size_t>& by_rate = system_->factorised().rate_dependent;
  for (const std::size_t c : by_rate)
    friction_.emplace_back(model_.contacts[c], c, slip_sign(system_->states()[c].state),
                           system_->rows()[c].normal, series);
  if (by_rate.empty()) return;
  if (std::any_of(friction_.begin(), friction_.end(),
                  [](const FrictionSeries& f) { return f.is_ambiguous(); }))
    resolve_ambiguities(forcing, series);
  for (const FrictionSeries& friction : friction_)
    for (const auto& [dof, factor] : model_.contacts[friction.contact()].tangent.terms)
      series.u(dof, 0) += factor * friction.jump();  // zero if the point has mass
  if (StateSystemPtr at = system_with_friction()) system_ = std::move(at);
}

double Taylor::friction_reach(std::size_t degree, double x) const {
  for (const FrictionSeries& friction : friction_) x = friction.reach(degree, x);
  return x;
}

StateSystemPtr Taylor::system_with_friction() const {
  std::vector<Form> rows;
  for (const FrictionSeries& friction : friction_) rows.push_back(friction.row());
  return systems_.with_friction(*system_, rows);
}

/// Computes two levels in which all ambiguous points follow quasi-statically. They give accelerations and thus the rates of
/// the points. Points whose rate reaches max_rate() stay quasi-static.
void Taylor::resolve_ambiguities(const Forcing& forcing, Series& series) {
  const std::vector<FrictionSeries> given = friction_;
  const StateSystemPtr own = system_;
  for (FrictionSeries& friction : friction_)
    if (friction.is_ambiguous()) friction.follow_quasi_statically();
  std::vector<FrictionSeries> settled = given;
  if (StateSystemPtr at = system_with_friction()) {
    const Eigen::MatrixXd before = series.u;
    system_ = std::move(at);
    for (int k = 0; k < 2; ++k) level(forcing, k, series, nullptr);
    for (std::size_t i = 0; i < given.size(); ++i)
      if (given[i].is_ambiguous() && friction_[i].rate_in(series) >= given[i].max_rate())
        settled[i].follow_quasi_statically();
    series.u = before;
  }
  system_ = own;
  friction_ = std::move(settled);
}

/// Adds those forces of curved surfaces that are not in K: products of the series of N and of ut.
void Taylor::add_restoring_forces(int order, const Series& series) {
  for (const std::size_t c : curved_contacts_) {
    const Contact& contact = model_.contacts[c];
    const Form& row = system_->rows()[c].normal;
    const auto k = static_cast<std::size_t>(order);
    double force = 0.0;
    for (std::size_t j = 0; j <= k; ++j) {
      const double N = normal_coefficient(contact, c, row, series, j);
      const double* u = series.u.data() + (k - j) * static_cast<std::size_t>(series.u.rows());
      const double ut =
          contact.body_tangent().dot(u) - series.forcing.surface[c * series.forcing.count + k - j];
      // The constant N_K (contact/curved_surface.hpp) is subtracted only once, in the term j = 0.
      force += j == 0 ? contact::restoring_force(contact, N, ut) : contact::restoring_product(contact, N, ut);
    }
    contact.body_tangent().add_to(x_, -force);
  }
}

double Taylor::prescribed_value(const linear::PrescribedDof& p, int order, const Series& series) const {
  if (p.tangent == 0.0) return 0.0;
  const ForcingSeries& f = series.forcing;
  const double second = static_cast<double>((order + 1) * (order + 2)) / (series.scale * series.scale);
  return second * f.surface[p.contact * f.count + static_cast<std::size_t>(order) + 2] * p.tangent /
         p.divisor;
}

/// Known parts r and q of the normal and tangent row of contact c at level k: applied normal force, surface, gap, constants.
void Taylor::known_row_parts(std::size_t c, int order, const Series& series, double& r, double& q) const {
  const Form &normal = system_->rows()[c].normal, &tangent = system_->rows()[c].tangent;
  const ForcingSeries& f = series.forcing;
  const double to_velocity = (order + 1) / series.scale;
  const double* surface = f.surface.data() + c * f.count + static_cast<std::size_t>(order);
  const double* applied = f.applied_normal_force.data() + c * f.count + static_cast<std::size_t>(order);
  r = normal.applied_normal_force * applied[0];
  q = -tangent.ut * surface[0] - tangent.vt * to_velocity * surface[1] -
      tangent.at * to_velocity * (order + 2) / series.scale * surface[2];
  if (order > 0) return;
  r += normal.constant + normal.gap * model_.contacts[c].gap;
  q += tangent.constant;
}

namespace {

/// True if a surface motion or an applied normal force is nonzero at this order; most are polynomials of low degree.
bool is_driven(const ForcingSeries& f, std::size_t c, int order) {
  const std::size_t at = c * f.count + static_cast<std::size_t>(order);
  const double *surface = f.surface.data() + at, *applied = f.applied_normal_force.data() + at;
  return surface[0] != 0.0 || surface[1] != 0.0 || surface[2] != 0.0 || applied[0] != 0.0;
}

}  // namespace

/// Sizes known at compile time (0: unknown) allow the compiler to unroll the loops for one or two masses.
template <std::size_t fixed_n, std::size_t fixed_size>
void Taylor::level_dense(const Forcing& forcing, int order, Series& series) {
  const FactorisedStates& mode = system_->factorised();
  const std::size_t n = fixed_n > 0 ? fixed_n : known_u_.size();
  const std::size_t size = fixed_size > 0 ? fixed_size : x_.size();
  const double to_velocity = (order + 1) / series.scale;
  const double to_acceleration = to_velocity * (order + 2) / series.scale;
  const double* u_k = series.u.data() + static_cast<std::size_t>(order) * n;
  const double* u_k1 = u_k + n;
  double* u_k2 = series.u.data() + static_cast<std::size_t>(order + 2) * n;
  double *x = x_.data(), *y = work_.data();
  const double *from_u = mode.from_u.data(), *from_v = mode.from_v.data();
  if constexpr (fixed_size == 0) {
    fused_products(from_u, from_v, size, n, u_k, u_k1, to_velocity, y);
  } else {
    for (std::size_t i = 0; i < size; ++i) y[i] = 0.0;
    for (std::size_t j = 0; j < n; ++j, from_u += size, from_v += size) {
      const double u = u_k[j], v = to_velocity * u_k1[j];
      for (std::size_t i = 0; i < size; ++i) y[i] += from_u[i] * u + from_v[i] * v;
    }
  }
  if (order == 0 || forcing.varies()) {
    for (std::size_t i = 0; i < size; ++i) x[i] = 0.0;
    forcing.add_load(series.forcing, static_cast<std::size_t>(order), x);
    for (std::size_t c = 0; c < mode.unknowns.layout.contacts(); ++c) {
      if (order > 0 && !(forcing.is_driven(c) && is_driven(series.forcing, c, order))) continue;
      double r = 0.0, q = 0.0;
      known_row_parts(c, order, series, r, q);
      x[mode.unknowns.normal(c)] = -r;
      x[mode.unknowns.tangent(c)] = -q;
    }
    const double* column = mode.inverse.data();
    for (std::size_t j = 0; j < size; ++j, column += size) {
      const double xj = x[j];
      if (xj == 0.0) continue;
      for (std::size_t i = 0; i < size; ++i) y[i] += column[i] * xj;
    }
  }
  for (const linear::PrescribedDof& p : mode.prescribed) y[p.dof] = prescribed_value(p, order, series);
  const double to_u = 1.0 / to_acceleration;
  for (std::size_t i = 0; i < n; ++i) u_k2[i] = y[i] * to_u;
  double* forces = series.forces.data() + static_cast<std::size_t>(order) * (size - n);
  for (std::size_t i = n; i < size; ++i) forces[i - n] = y[i];
}

void Taylor::level(const Forcing& forcing, int order, Series& series, const DataPerturbation* disturbance) {
  if (massless_ || disturbance != nullptr || additional_loads_ || !curved_contacts_.empty() ||
      !system_->factorised().dense())
    return level_any(forcing, order, series, disturbance);
  const std::size_t masses = known_u_.size(), unknowns = x_.size();
  if (masses == 1 && unknowns == 3) return level_dense<1, 3>(forcing, order, series);
  if (masses == 2 && unknowns == 4) return level_dense<2, 4>(forcing, order, series);
  if (masses == 2 && unknowns == 6) return level_dense<2, 6>(forcing, order, series);
  return level_dense<0, 0>(forcing, order, series);
}

/// Writes the parts of u and v at level k that are not unknowns of this level.
void Taylor::set_known_motion(int order, const Series& series) {
  const std::size_t n = known_u_.size();
  const double to_velocity = (order + 1) / series.scale;
  const double *u_k = series.u.col(order).data(), *u_k1 = series.u.col(order + 1).data();
  if (!massless_) {
    for (std::size_t i = 0; i < n; ++i) {
      known_u_[i] = u_k[i];
      known_v_[i] = to_velocity * u_k1[i];
    }
    return;
  }
  const std::vector<linear::DofKind>& kinds = system_->kinds();
  for (std::size_t i = 0; i < n; ++i) {
    known_u_[i] = kinds[i] == linear::DofKind::algebraic ? 0.0 : u_k[i];
    known_v_[i] = kinds[i] == linear::DofKind::massive ? to_velocity * u_k1[i] : 0.0;
  }
  for (const linear::UndampedMotion& motion : system_->undamped())
    for (const auto& [dof, factor] : motion.others)
      known_u_[static_cast<std::size_t>(dof)] -= factor * u_k[motion.dof];
}

/// Adds the magnitudes of the terms of the equations of motion at level k, including rounding errors of lower levels.
void Taylor::measure_equations(const Forcing& forcing, int order, const Series& series, double* terms) const {
  const std::size_t n = known_u_.size();
  const double to_velocity = (order + 1) / series.scale;
  const double to_acceleration = to_velocity * (order + 2) / series.scale;
  const double *u = sizes_.col(order).data(), *v = sizes_.col(order + 1).data();
  const double* a = series.u.col(order + 2).data();
  forcing.add_load_terms(series.forcing, static_cast<std::size_t>(order), terms);
  for (std::size_t j = 0; j < n; ++j) {
    const double uj = u[j], vj = to_velocity * v[j], aj = std::abs(to_acceleration * a[j]);
    for (auto p = static_cast<std::size_t>(structure_.column_start[j]);
         p < static_cast<std::size_t>(structure_.column_start[j + 1]); ++p)
      terms[structure_.row[p]] +=
          std::abs(structure_.m[p]) * aj + std::abs(structure_.c[p]) * vj + std::abs(structure_.k[p]) * uj;
  }
}

/// Adds the magnitudes of a contact's forces in the equations of motion.
void Taylor::measure_forces(std::size_t c, int order, const Series& series, double* terms) const {
  const double* forces =
      series.forces.data() + static_cast<std::size_t>(order) * (x_.size() - known_u_.size());
  for (const auto& [dof, factor] : model_.contacts[c].normal.terms)
    terms[dof] += std::abs(factor * forces[model_.layout.normal(c)]);
  for (const auto& [dof, factor] : model_.contacts[c].tangent.terms)
    terms[dof] += std::abs(factor * forces[model_.layout.tangent(c)]);
}

/// Magnitudes of the terms in the contact's rows. kn g is a difference of large numbers, so its rounding error is that of its
/// terms. A row that contains an acceleration has the rounding error of the forces whose difference is the acceleration.
void Taylor::measure_rows(std::size_t c, int order, const Series& series, double* terms) const {
  const Contact& contact = model_.contacts[c];
  const Form &normal = system_->rows()[c].normal, &tangent = system_->rows()[c].tangent;
  const ForcingSeries& f = series.forcing;
  const std::size_t n = known_u_.size(), k = static_cast<std::size_t>(order);
  const double to_velocity = (order + 1) / series.scale;
  const double to_acceleration = to_velocity * (order + 2) / series.scale;
  const double *u = sizes_.col(order).data(), *v = sizes_.col(order + 1).data();
  const double* forces = series.forces.data() + k * (x_.size() - n);
  const double N = forces[model_.layout.normal(c)], T = forces[model_.layout.tangent(c)];
  const double *applied = f.applied_normal_force.data() + c * f.count + k,
               *surface = f.surface.data() + c * f.count + k;
  double r = std::abs(normal.N * N) + std::abs(normal.applied_normal_force * applied[0]);
  double q = std::abs(tangent.N * N) + std::abs(tangent.T * T) + std::abs(tangent.ut * surface[0]) +
             std::abs(tangent.vt * to_velocity * surface[1]) +
             std::abs(tangent.at * to_acceleration * surface[2]);
  if (order == 0) {
    r += std::abs(normal.constant) + std::abs(normal.gap * contact.gap);
    q += std::abs(tangent.constant);
  }
  const auto sum = [&](const Combination& form, double of_u, double of_v, double of_a) {
    double result = 0.0;
    for (const auto& [dof, factor] : form.terms)
      result += std::abs(factor) * (std::abs(of_u) * u[dof] + std::abs(of_v) * to_velocity * v[dof] +
                                    std::abs(of_a) * mobility_[static_cast<std::size_t>(dof)] * terms[dof]);
    return result;
  };
  r += sum(contact.normal, normal.gap, normal.vn, normal.an);
  q += sum(contact.tangent, tangent.ut, tangent.vt, tangent.at);
  terms[system_->unknowns().normal(c)] = r;
  terms[system_->unknowns().tangent(c)] = q;
}

/// Perturbs each equation by a few rounding errors of its terms, like the backward error of a solution.
void Taylor::perturb(const Forcing& forcing, int order, const DataPerturbation& disturbance) {
  const Series& motion = disturbance.motion;
  if (order == 0) {
    terms_.resize(static_cast<Eigen::Index>(x_.size()), motion.levels + 1);
    sizes_.resize(motion.u.rows(), motion.u.cols());
    sizes_.leftCols(2) = motion.u.leftCols(2).cwiseAbs();
  }
  sizes_.col(order + 2) = motion.u.col(order + 2).cwiseAbs();
  terms_.col(order).setZero();
  double* terms = terms_.col(order).data();
  measure_equations(forcing, order, motion, terms);
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) measure_forces(c, order, motion, terms);
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) measure_rows(c, order, motion, terms);
  for (std::size_t i = 0; i < x_.size(); ++i)
    x_[i] += parts_[i + x_.size() * static_cast<std::size_t>(order)] * terms[i];
  // The rounding error of u_(order + 2) enters the terms of later levels. Its magnitude is estimated by the mass alone.
  const double to_acceleration = (order + 1) * (order + 2) / (motion.scale * motion.scale);
  double* carried = sizes_.col(order + 2).data();
  for (std::size_t i = 0; i < known_u_.size(); ++i) carried[i] += mobility_[i] * terms[i] / to_acceleration;
  for (const linear::PrescribedDof& p : system_->factorised().prescribed)
    carried[p.dof] = std::abs(motion.u(static_cast<Eigen::Index>(p.dof), order + 2));
}

/// Writes the solution of level k into the series.
void Taylor::take(int order, Series& series) const {
  const std::size_t n = known_u_.size();
  const double to_velocity = (order + 1) / series.scale;
  const double to_acceleration = to_velocity * (order + 2) / series.scale;
  double *u_k = series.u.col(order).data(), *u_k1 = series.u.col(order + 1).data(),
         *u_k2 = series.u.col(order + 2).data();
  const std::vector<linear::DofKind>& kinds = system_->kinds();
  for (std::size_t i = 0; i < n; ++i) {
    if (kinds[i] == linear::DofKind::massive)
      u_k2[i] = x_[i] / to_acceleration;
    else if (kinds[i] == linear::DofKind::damped)
      u_k1[i] = x_[i] / to_velocity;
    else
      u_k[i] = x_[i];
  }
  for (const linear::UndampedMotion& motion : system_->undamped())
    for (const auto& other : motion.others)
      u_k[other.first] = known_u_[static_cast<std::size_t>(other.first)];
  for (const linear::UndampedMotion& motion : system_->undamped())
    for (const auto& [dof, factor] : motion.others)
      u_k[dof] += factor * x_[static_cast<std::size_t>(motion.dof)];
  std::copy(x_.begin() + static_cast<std::ptrdiff_t>(n), x_.end(), series.forces.col(order).data());
}

void Taylor::level_any(const Forcing& forcing, int order, Series& series,
                       const DataPerturbation* disturbance) {
  const std::size_t n = known_u_.size();
  set_known_motion(order, series);
  std::fill(x_.begin(), x_.begin() + static_cast<std::ptrdiff_t>(n), 0.0);
  forcing.add_load(series.forcing, static_cast<std::size_t>(order), x_.data());
  if (additional_loads_) additional_loads_(order, x_.data());
  structure_.subtract_forces(known_v_.data(), known_u_.data(), x_.data());
  const linear::Unknowns& at = system_->unknowns();
  for (std::size_t c = 0; c < at.layout.contacts(); ++c) {
    const Contact& contact = model_.contacts[c];
    const Form &normal = system_->rows()[c].normal, &tangent = system_->rows()[c].tangent;
    double r = 0.0, q = 0.0;
    if (order == 0 || forcing.is_driven(c)) known_row_parts(c, order, series, r, q);
    if (normal.gap != 0.0) r += normal.gap * contact.normal.dot(known_u_.data());
    if (normal.vn != 0.0) r += normal.vn * contact.normal.dot(known_v_.data());
    if (tangent.ut != 0.0) q += tangent.ut * contact.tangent.dot(known_u_.data());
    if (tangent.vt != 0.0) q += tangent.vt * contact.tangent.dot(known_v_.data());
    x_[at.normal(c)] = -r;
    x_[at.tangent(c)] = -q;
  }
  if (!curved_contacts_.empty()) add_restoring_forces(order, series);
  for (FrictionSeries& friction : friction_)
    x_[at.tangent(friction.contact())] -= friction.known(order, series);
  if (disturbance != nullptr) perturb(forcing, order, *disturbance);

  system_->solve(x_.data(), work_.data());
  if (disturbance == nullptr)
    for (const linear::PrescribedDof& p : system_->factorised().prescribed)
      if (system_->kinds()[p.dof] == linear::DofKind::massive) x_[p.dof] = prescribed_value(p, order, series);
  take(order, series);
}

void Taylor::expand(const StateSystemPtr& system, const Forcing& forcing, double t, const Vector& u,
                    const Vector& v, int levels, double scale, Series& out,
                    const DataPerturbation* disturbance) {
  begin(system, forcing, t, u, v, levels, scale, out, disturbance);
  for (int k = 0; k <= levels; ++k) level(forcing, k, out, disturbance);
  out.levels = levels;
}

void Taylor::begin(const StateSystemPtr& system, const Forcing& forcing, double t, const Vector& u,
                   const Vector& v, int levels, double scale, Series& out,
                   const DataPerturbation* disturbance) {
  system_ = system;
  out.t = t;
  out.scale = scale;
  out.levels = -1;
  out.layout = model_.layout;
  out.u.setZero(u.size(), levels + 3);
  out.forces.resize(model_.force_count(), levels + 1);
  forcing.expand(t, scale, static_cast<std::size_t>(levels) + 3, out.forcing);
  out.u.col(0) = u;
  for (Eigen::Index i = 0; i < u.size(); ++i)
    if (system->kinds()[static_cast<std::size_t>(i)] == linear::DofKind::massive) out.u(i, 1) = scale * v[i];
  if (disturbance != nullptr) {
    const std::size_t n = known_u_.size(), data = x_.size() * static_cast<std::size_t>(levels + 1);
    while (parts_.size() < data + 2 * n) parts_.push_back(DataPerturbation::fraction(parts_.size()));
    for (std::size_t i = 0; i < 2 * n; ++i) out.u.data()[i] *= 1.0 + parts_[data + i];
  }
  start_friction(forcing, out);
}

void Taylor::extend(const Forcing& forcing, int levels, Series& out, const DataPerturbation* disturbance) {
  for (int k = out.levels + 1; k <= levels; ++k) level(forcing, k, out, disturbance);
  out.levels = std::max(out.levels, levels);
}

}  // namespace signorini::motion
