#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "law_check/laws.hpp"

namespace signorini::law_check {

/// Factors of M, restricted to the degrees of freedom that have mass.
struct CheckContext::Factor {
  std::vector<int> dofs;
  Eigen::SimplicialLDLT<SparseMatrix> ldlt;
  bool made = false;
};

CheckContext::CheckContext(const Model& model_, const LawLimits& limits_)
    : model(model_),
      limits(limits_),
      rotation_mask_(Vector::Zero(model_.size())),
      springs_(springs_of(model_)),
      factor_(std::make_unique<Factor>()),
      responses_(model_.contacts.size()) {
  for (int i = 0; i < model.size(); ++i) {
    massive_.push_back(!model.dofs[static_cast<std::size_t>(i)].massless);
    if (massive_.back()) factor_->dofs.push_back(i);
    if (model.dofs[static_cast<std::size_t>(i)].rotation) rotation_mask_[i] = 1.0;
  }
  find_massless();
}

/// Upper triangle of K, including the springs of contacts, with doubled off-diagonal entries, so that u^T K u is the sum
/// over its entries.
SparseMatrix CheckContext::springs_of(const Model& model) {
  std::vector<Eigen::Triplet<double>> terms;
  const auto add = [&](int i, int j, double value) {
    if (i <= j && value != 0.0) terms.emplace_back(i, j, i < j ? 2.0 * value : value);
  };
  for (int j = 0; j < model.stiffness.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(model.stiffness, j); it; ++it)
      add(static_cast<int>(it.row()), j, it.value());
  const auto add_spring = [&](const Combination& form, double k) {
    for (const auto& [i, factor] : form.terms)
      for (const auto& [j, other] : form.terms) add(i, j, k * factor * other);
  };
  for (const Contact& c : model.contacts) {
    add_spring(c.normal, c.normal_stiffness);
    add_spring(c.body_tangent(), c.tangential_stiffness.value_or(0.0));
  }
  SparseMatrix springs(model.size(), model.size());
  springs.setFromTriplets(terms.begin(), terms.end());
  return springs;
}

double CheckContext::twice_energy(const Vector& u) const {
  double twice = 0.0;
  for (int j = 0; j < springs_.outerSize(); ++j) {
    double force = 0.0;
    for (SparseMatrix::InnerIterator it(springs_, j); it; ++it) force += it.value() * u[it.row()];
    twice += force * u[j];
  }
  return std::max(0.0, twice);
}

void CheckContext::find_massless() {
  for (int i = 0; i < model.size(); ++i)
    if (!has_mass(i)) massless_.push_back(i);
  if (massless_.empty()) return;
  stiffness_by_rows_ = model.stiffness.transpose();
  damping_by_rows_ = model.damping.transpose();
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    const auto without = [&](const auto& term) { return !has_mass(term.first); };
    if (std::any_of(c.normal.terms.begin(), c.normal.terms.end(), without) ||
        std::any_of(c.tangent.terms.begin(), c.tangent.terms.end(), without))
      on_massless_.push_back(k);
  }
}

CheckContext::~CheckContext() = default;

Vector CheckContext::solve_mass(const Vector& x) const {
  Factor& f = *factor_;
  if (!std::exchange(f.made, true)) {
    std::vector<int> place(static_cast<std::size_t>(model.size()), -1);
    for (std::size_t i = 0; i < f.dofs.size(); ++i)
      place[static_cast<std::size_t>(f.dofs[i])] = static_cast<int>(i);
    std::vector<Eigen::Triplet<double>> terms;
    for (int j = 0; j < model.mass.outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(model.mass, j); it; ++it) {
        const int row = place[static_cast<std::size_t>(it.row())],
                  column = place[static_cast<std::size_t>(j)];
        if (row >= 0 && column >= 0) terms.emplace_back(row, column, it.value());
      }
    SparseMatrix mass(static_cast<Eigen::Index>(f.dofs.size()), static_cast<Eigen::Index>(f.dofs.size()));
    mass.setFromTriplets(terms.begin(), terms.end());
    f.ldlt.compute(mass);
  }
  if (f.ldlt.info() != Eigen::Success) return {};
  Vector part(static_cast<Eigen::Index>(f.dofs.size()));
  for (std::size_t i = 0; i < f.dofs.size(); ++i) part[static_cast<Eigen::Index>(i)] = x[f.dofs[i]];
  part = f.ldlt.solve(part);
  Vector result = Vector::Zero(model.size());
  for (std::size_t i = 0; i < f.dofs.size(); ++i) result[f.dofs[i]] = part[static_cast<Eigen::Index>(i)];
  return result;
}

std::array<double, 2> CheckContext::max_entries(const Vector& x) const {
  if (x.size() == 0) return {0.0, 0.0};
  return {(x.array().abs() * (1.0 - rotation_mask_.array())).maxCoeff(),
          (x.array().abs() * rotation_mask_.array()).maxCoeff()};
}

const std::array<double, 2>& CheckContext::inverse_mass_root() const {
  if (lightness_) return *lightness_;
  lightness_.emplace(std::array<double, 2>{0.0, 0.0});
  for (int i = 0; i < model.size(); ++i) {
    if (!has_mass(i)) continue;
    const Vector column = solve_mass(Vector::Unit(model.size(), i));
    if (column.size() == 0) break;
    double& greatest = (*lightness_)[model.dofs[static_cast<std::size_t>(i)].rotation];
    greatest = std::max(greatest, std::sqrt(std::max(0.0, column[i])));
  }
  return *lightness_;
}

const ContactResponse* CheckContext::contact_response(std::size_t k) const {
  const Contact& c = model.contacts[k];
  for (const Combination* form : {&c.normal, &c.tangent})
    for (const auto& [dof, factor] : form->terms)
      if (!has_mass(dof)) return nullptr;
  if (!responses_[k]) {
    Vector n = Vector::Zero(model.size()), t = n;
    c.normal.add_to(n, 1.0);
    c.tangent.add_to(t, 1.0);
    n = solve_mass(n);
    t = solve_mass(t);
    if (n.size() == 0 || t.size() == 0) return nullptr;
    const double nn = c.normal.dot(n), nt = c.normal.dot(t), tt = c.tangent.dot(t);
    responses_[k] = ContactResponse{std::move(n), std::move(t), nn, nt, tt};
  }
  return &*responses_[k];
}

double CheckContext::balance_terms(const CheckedSide& side) const {
  Vector sum = Vector::Zero(model.size());
  const auto add = [&](const SparseMatrix& matrix, const Vector* x) {
    if (x == nullptr) return;
    for (int j = 0; j < matrix.outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(matrix, j); it; ++it)
        sum[it.row()] += std::abs(it.value() * (*x)[j]);
  };
  add(model.mass, side.a);
  add(model.damping, side.v);
  add(model.stiffness, side.u);
  for (std::size_t k = 0; side.forces != nullptr && k < model.contacts.size(); ++k) {
    const auto n = static_cast<Eigen::Index>(model.layout.normal(k)),
               t = static_cast<Eigen::Index>(model.layout.tangent(k));
    for (const auto& [dof, factor] : model.contacts[k].normal.terms)
      sum[dof] += std::abs(factor * (*side.forces)[n]);
    for (const auto& [dof, factor] : model.contacts[k].tangent.terms)
      sum[dof] += std::abs(factor * (*side.forces)[t]);
  }
  return sum.size() > 0 ? sum.maxCoeff() : 0.0;
}

double CheckContext::capture_speed(const Vector& captures, std::size_t k) const {
  const ContactResponse* own = captures.size() > 0 ? contact_response(k) : nullptr;
  double speed = 0.0;
  for (std::size_t l = 0; own != nullptr && l < model.contacts.size(); ++l) {
    const Contact& c = model.contacts[l];
    const auto n = static_cast<Eigen::Index>(model.layout.normal(l)),
               t = static_cast<Eigen::Index>(model.layout.tangent(l));
    for (const Vector* by : {&own->by_n, &own->by_t})
      speed += std::abs(c.normal.dot(*by) * captures[n]) + std::abs(c.tangent.dot(*by) * captures[t]);
  }
  return speed;
}

double CheckContext::max_gap_acceleration(const InstantRecord& record, std::size_t k) const {
  const ContactKinematics m = kinematics(model.contacts[k], k, record.after);
  const ContactResponse* own = contact_response(k);
  return std::abs(m.ddg) + (own != nullptr ? own->nn * std::abs(m.N) : 0.0);
}

double CheckContext::max_contact_acceleration(const InstantRecord& record, std::size_t k) const {
  const Contact& c = model.contacts[k];
  const ContactKinematics after = kinematics(c, k, record.after), before = kinematics(c, k, record.before);
  const ContactResponse* own = contact_response(k);
  if (own == nullptr) return std::max(std::abs(after.ddg), std::abs(after.ddut));
  double n = 0.0, t = 0.0;  // accelerations before minus accelerations after, along n and t
  for (std::size_t j = 0; j < model.contacts.size(); ++j) {
    const Contact& other = model.contacts[j];
    const ContactKinematics b = kinematics(other, j, record.before), a = kinematics(other, j, record.after);
    for (const auto& [form, force] :
         {std::pair(&other.normal, a.N - b.N), std::pair(&other.tangent, a.T - b.T)}) {
      n += force * form->dot(own->by_n);
      t += force * form->dot(own->by_t);
    }
  }
  const double held = std::max(own->nn * std::max(std::abs(before.N), std::abs(after.N)),
                               own->tt * std::max(std::abs(before.T), std::abs(after.T)));
  return held + std::max({std::abs(after.ddg), std::abs(after.ddg + n), std::abs(after.ddut),
                          std::abs(after.ddut + t)});
}

Vector CheckContext::capture_velocities(const InstantRecord& record) const {
  if (!(limits.step > 0.0) || record.captures.size() == 0 || record.captures.isZero(0.0)) return {};
  Vector impulse = Vector::Zero(model.size());
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const auto n = static_cast<Eigen::Index>(model.layout.normal(k)),
               t = static_cast<Eigen::Index>(model.layout.tangent(k));
    model.contacts[k].normal.add_to(impulse, record.captures[n]);
    model.contacts[k].tangent.add_to(impulse, record.captures[t]);
  }
  return solve_mass(impulse);
}

Vector CheckContext::capture_accelerations(const InstantRecord& record) const {
  const Vector dv = capture_velocities(record);
  return dv.size() > 0 ? solve_mass(model.damping * dv) : Vector();
}

double CheckContext::rest_speed(const InstantRecord& record, std::size_t k) const {
  const Contact& c = model.contacts[k];
  const ContactKinematics m = kinematics(c, k, record.after), b = kinematics(c, k, record.before);
  const double pull = this->max_gap_acceleration(record, k);
  const double size = m.displacement_size + b.displacement_size, speed = m.velocity_size + b.velocity_size;
  double clock = record.resolution;
  for (const RecordedEvent& event : record.events)
    if (event.contact == k) clock = std::max(clock, uncertainty_factor * event.t_uncertainty);
  double low = c.capture_velocity.value_or(limits.capture_velocity) + rounding::elimination * speed +
               tolerance_factor * (limits.rtol * speed + limits.velocity) + clock * pull;
  const double gap =
      rounding::elimination * size + tolerance_factor * (limits.rtol * size + limits.displacement);
  if (!limits.resolves_low_flights) low += std::sqrt(2.0 * pull * gap);
  return low;
}

namespace {

/// |w|^T |matrix| |x|: sum of the absolute terms of w^T matrix x.
double terms_of(const Vector& w, const SparseMatrix& matrix, const Vector& x) {
  double sum = 0.0;
  for (int j = 0; j < matrix.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(matrix, j); it; ++it)
      sum += std::abs(w[it.row()] * it.value() * x[j]);
  return sum;
}

}  // namespace

/// The weights follow from the constraint forces l of all contacts just before the instant. R: rows of the constrained
/// accelerations; F: directions of the forces, which include friction for sliding contacts:
///
///     R M^-1 (f - F l) = asked,  f = P - C v - K u - springs
///     =>    l_k = w_k . f + ...,   w_k = M^-1 R^T A^-T e_k,  A = R M^-1 F
///
/// All contacts are included, because A^-1 amplifies errors of f if another contact has nearly the same row as contact k.
ConstraintForceWeights CheckContext::constraint_force_weights(const InstantRecord& record,
                                                              std::size_t k) const {
  std::vector<const Combination*> forms;
  std::vector<const Vector*> rows;
  std::vector<Vector> columns;
  Eigen::Index normal = -1, tangent = -1;
  for (std::size_t j = 0; j < model.contacts.size(); ++j) {
    const Contact& c = model.contacts[j];
    const ContactState& state = (*record.before.mode)[j];
    const ContactResponse* own = is_open(state.state) || !c.obeys_coulomb() ? nullptr : contact_response(j);
    if (own == nullptr) continue;
    const ContactKinematics m = kinematics(c, j, record.before);
    const bool sticks = c.constrains_tangent(state.state);
    if (c.takes_impulses()) {
      const double friction = sticks || c.tangential_stiffness
                                  ? 0.0
                                  : -slip_direction(state.state) * friction_in(c, state.state, m.dut, m.N);
      if (j == k) normal = static_cast<Eigen::Index>(rows.size());
      forms.push_back(&c.normal);
      rows.push_back(&own->by_n);
      columns.emplace_back(own->by_n + friction * own->by_t);
    }
    if (!sticks) continue;
    if (j == k) tangent = static_cast<Eigen::Index>(rows.size());
    forms.push_back(&c.tangent);
    rows.push_back(&own->by_t);
    columns.push_back(own->by_t);
  }
  if (normal < 0 && tangent < 0) return {};
  const auto size = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd A(size, size);
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = 0; j < size; ++j)
      A(i, j) = forms[static_cast<std::size_t>(i)]->dot(columns[static_cast<std::size_t>(j)]);
  const Eigen::MatrixXd inverse = base::pseudo_inverse(A);
  const auto weights = [&](Eigen::Index row) {
    Vector w;
    if (row < 0) return w;
    w.setZero(model.size());
    for (Eigen::Index i = 0; i < size; ++i) w += inverse(row, i) * *rows[static_cast<std::size_t>(i)];
    return w;
  };
  return {weights(normal), weights(tangent)};
}

/// Contribution of dampers, and of dashpots of closed contacts, to w . f for velocities v.
double CheckContext::damped(const InstantRecord& record, const Vector& w, const Vector& v) const {
  double sum = w.dot(model.damping * v);
  for (std::size_t j = 0; j < model.contacts.size(); ++j) {
    const Contact& c = model.contacts[j];
    const State state = (*record.before.mode)[j].state;
    if (is_open(state) || !(c.normal_damping > 0.0)) continue;
    const ContactKinematics m = kinematics(c, j, record.before);
    const double friction = -slip_direction(state) * friction_in(c, state, m.dut, m.N);
    sum += c.normal_damping * (c.normal.dot(w) + friction * c.tangent.dot(w)) * c.normal.dot(v);
  }
  return sum;
}

/// The engine and the decision compute w . f separately from u and v just before the instant; the decision first removes
/// velocities below the accuracy of steps. The difference of both values consists of
///   - rounding, 1000 eps of  |w| (|M| |a| + |C| |v| + |K| |u|)  and of the terms of springs and forces of all
///     contacts; with `ida` also tolerance_factor tolerances, as for other rows;
///   - in modes, du and dv with  du^T K du <= lost^2,  dv^T M dv <= lost^2  (Schwarz):
///         |w . K du| <= lost sqrt( w^T K w ),   |w . C dv| <= lost sqrt( (C w)^T M^-1 (C w) );
///   - for fixed steps, w . C dv for the velocities dv that captures remove; C includes the dashpots of contacts.
double CheckContext::constraint_force_noise(const InstantRecord& record, const Vector& w) const {
  if (w.size() == 0) return 0.0;
  const CheckedSide& side = record.before;
  double terms = terms_of(w, model.stiffness, *side.u) + terms_of(w, model.damping, *side.v);
  if (record.after.a != nullptr) terms += terms_of(w, model.mass, *record.after.a);
  for (std::size_t j = 0; j < model.contacts.size(); ++j) {
    const Contact& c = model.contacts[j];
    const ContactState& state = (*side.mode)[j];
    const ContactKinematics m = kinematics(c, j, side);
    const double along_n = std::abs(c.normal.dot(w)), along_t = std::abs(c.tangent.dot(w));
    terms += along_n * std::abs(m.N) + along_t * std::abs(m.T);
    if (is_open(state.state)) continue;
    terms += along_n * normal_force_size(c, m) +
             along_t * c.tangential_stiffness.value_or(0.0) * (m.displacement_size + std::abs(state.anchor));
  }
  double noise = (rounding::elimination + tolerance_factor * limits.rtol) * terms;
  if (side.modal_mismatch > 0.0) {
    const Vector by_damping = model.damping * w;
    noise += side.modal_mismatch *
             (std::sqrt(twice_energy(w)) + std::sqrt(std::max(0.0, by_damping.dot(solve_mass(by_damping)))));
  }
  if (const Vector dv = capture_velocities(record); dv.size() > 0)
    noise += uncertainty_factor * std::abs(damped(record, w, dv));
  return noise;
}

}  // namespace signorini::law_check
