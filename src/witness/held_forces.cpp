#include <algorithm>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "witness/laws.hpp"

namespace signorini {
namespace {

/// Sum of |w| |matrix| |x|, without cancellation.
double terms_of(const Vector& w, const SparseMatrix& matrix, const Vector& x) {
  double sum = 0.0;
  for (int j = 0; j < matrix.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(matrix, j); it; ++it)
      sum += std::abs(w[it.row()] * it.value() * x[j]);
  return sum;
}

}  // namespace

/// Weights w of contact k's forces among all forces that enforce constraints just before: rows R of accelerations, and
/// columns F of forces l, which include friction for sliding contacts:
///
///     R M^-1 (f - F l) = asked,  f = P - C v - K u - springs
///     =>    l_k = w_k . f + ...,   w_k = M^-1 R^T A^-T e_k,  A = R M^-1 F
///
/// Another contact with nearly the same rows amplifies noise of f by A^-1; the rows of contact k alone would not show
/// this.
HeldForce Bench::held_force(const InstantRecord& record, std::size_t k) const {
  std::vector<const Combination*> forms;
  std::vector<const Vector*> rows;
  std::vector<Vector> columns;
  Eigen::Index normal = -1, tangent = -1;
  for (std::size_t j = 0; j < model.contacts.size(); ++j) {
    const Contact& c = model.contacts[j];
    const ContactState& state = (*record.before.mode)[j];
    const OwnResponse* own = is_open(state.state) || !c.obeys_coulomb() ? nullptr : own_response(j);
    if (own == nullptr) continue;
    const Sight m = see(c, j, record.before);
    const bool sticks = c.holds_tangent(state.state);
    if (c.takes_impulses()) {
      const double friction = sticks || c.tangential_stiffness
                                  ? 0.0
                                  : -sign_of_slip(state.state) * friction_in(c, state.state, m.dut, m.N);
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
  const Eigen::MatrixXd inverse = pseudo_inverse(A);
  const auto weights = [&](Eigen::Index row) {
    Vector w;
    if (row < 0) return w;
    w.setZero(model.size());
    for (Eigen::Index i = 0; i < size; ++i) w += inverse(row, i) * *rows[static_cast<std::size_t>(i)];
    return w;
  };
  return {weights(normal), weights(tangent)};
}

/// Contribution of dampers, and of dashpots of closed contacts, to the forces w . f, for velocities v.
double Bench::damped(const InstantRecord& record, const Vector& w, const Vector& v) const {
  double sum = w.dot(model.damping * v);
  for (std::size_t j = 0; j < model.contacts.size(); ++j) {
    const Contact& c = model.contacts[j];
    const State state = (*record.before.mode)[j].state;
    if (is_open(state) || !(c.normal_damping > 0.0)) continue;
    const Sight m = see(c, j, record.before);
    const double friction = -sign_of_slip(state) * friction_in(c, state, m.dut, m.N);
    sum += c.normal_damping * (c.normal.dot(w) + friction * c.tangent.dot(w)) * c.normal.dot(v);
  }
  return sum;
}

/// Difference between two sums of w . f, both from the u and v just before: the engine's, and the decision's, which
/// removes velocities that steps have left. It consists of
///   - rounding, 1000 eps of  |w| (|M| |a| + |C| |v| + |K| |u|)  and of the terms of springs and forces of all
///     contacts; with `ida` as many tolerances as for any other row;
///   - in modes, du and dv with  du^T K du <= lost^2,  dv^T M dv <= lost^2  (Schwarz):
///         |w . K du| <= lost sqrt( w^T K w ),   |w . C dv| <= lost sqrt( (C w)^T M^-1 (C w) );
///   - if steps have a given length, w . C dv for the velocities dv that captures remove, dashpots of contacts in C.
double Bench::held_noise(const InstantRecord& record, const Vector& w) const {
  if (w.size() == 0) return 0.0;
  const WitnessedSide& side = record.before;
  double terms = terms_of(w, model.stiffness, *side.u) + terms_of(w, model.damping, *side.v);
  if (record.after.a != nullptr) terms += terms_of(w, model.mass, *record.after.a);
  for (std::size_t j = 0; j < model.contacts.size(); ++j) {
    const Contact& c = model.contacts[j];
    const ContactState& state = (*side.mode)[j];
    const Sight m = see(c, j, side);
    const double along_n = std::abs(c.normal.dot(w)), along_t = std::abs(c.tangent.dot(w));
    terms += along_n * std::abs(m.N) + along_t * std::abs(m.T);
    if (is_open(state.state)) continue;
    terms += along_n * size_of_normal(c, m) +
             along_t * c.tangential_stiffness.value_or(0.0) * (m.place + std::abs(state.anchor));
  }
  double noise = (rounding::of_elimination + of_tolerance * limits.rtol) * terms;
  if (side.lost > 0.0) {
    const Vector by_damping = model.damping * w;
    noise += side.lost *
             (std::sqrt(twice_energy(w)) + std::sqrt(std::max(0.0, by_damping.dot(per_mass(by_damping)))));
  }
  if (const Vector dv = captured(record); dv.size() > 0)
    noise += of_uncertainty * std::abs(damped(record, w, dv));
  return noise;
}

}  // namespace signorini
