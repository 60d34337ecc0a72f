#include "decide/delassus.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/eigen_dense.hpp"
#include "base/least_norm.hpp"
#include "base/rounding.hpp"
#include "contact/friction.hpp"
#include "decide/coulomb_problem.hpp"
#include "linear/redundant_rows.hpp"

namespace signorini::decide {

Delassus delassus(const Model& model, const motion::StateSystem& system,
                  const std::vector<std::size_t>& contacts) {
  const auto n = static_cast<Eigen::Index>(model.size());
  const ForceLayout layout = model.layout.part(contacts);
  const Eigen::Index m = place_count(layout);
  Delassus d{Eigen::MatrixXd::Zero(n, m), Eigen::MatrixXd::Zero(m, m), layout};
  Vector x(static_cast<Eigen::Index>(system.unknowns().size())), work(x.size());
  for (Eigen::Index j = 0; j < m; ++j) {
    const auto place = static_cast<std::size_t>(j);
    if (!layout.is_used(place)) continue;
    const Contact& contact = model.contacts[contacts[layout.contact_of(place)]];
    x.setZero();
    (layout.is_normal(place) ? contact.normal : contact.tangent).add_to(x, 1.0);
    system.solve(x.data(), work.data());
    for (Eigen::Index i = 0; i < n; ++i)
      d.effect(i, j) = system.kinds()[static_cast<std::size_t>(i)] == linear::DofKind::massive ? x[i] : 0.0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const Contact& other = model.contacts[contacts[i]];
      d.W(normal_place(layout, i), j) = other.normal.dot(d.effect.col(j));
      d.W(tangent_place(layout, i), j) = other.tangent.dot(d.effect.col(j));
    }
  }
  return d;
}

Eigen::VectorXd with_reactions(const Model& model, const motion::StateSystem& system,
                               const std::vector<std::size_t>& contacts, const Eigen::VectorXd& impulses) {
  if (impulses.size() == 0) return {};
  const ForceLayout layout = model.layout.part(contacts);
  Vector x = Vector::Zero(static_cast<Eigen::Index>(system.unknowns().size())), work(x.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    model.contacts[contacts[i]].normal.add_to(x, impulses[normal_place(layout, i)]);
    model.contacts[contacts[i]].tangent.add_to(x, impulses[tangent_place(layout, i)]);
  }
  system.solve(x.data(), work.data());
  Eigen::VectorXd all = -x.tail(model.force_count());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    all.data()[model.layout.normal(contacts[i])] += impulses[normal_place(layout, i)];
    all.data()[model.layout.tangent(contacts[i])] += impulses[tangent_place(layout, i)];
  }
  return all;
}

bool has_velocities(const std::vector<FixedVelocity>& fixed, const Vector& v) {
  return std::all_of(fixed.begin(), fixed.end(),
                     [&](const FixedVelocity& f) { return f.value - f.form->dot(v) == 0.0; });
}

Eigen::VectorXd impose_velocities(const Delassus& d, const std::vector<FixedVelocity>& fixed, Vector& v) {
  if (has_velocities(fixed, v)) return {};
  const auto count = static_cast<Eigen::Index>(fixed.size());
  std::vector<Eigen::Index> rows;
  for (const FixedVelocity& f : fixed) rows.push_back(f.row);
  const Eigen::MatrixXd W = d.W(rows, rows), effect = d.effect(Eigen::all, rows);
  Eigen::VectorXd miss(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const FixedVelocity& f = fixed[static_cast<std::size_t>(i)];
    miss[i] = f.value - f.form->dot(v);
  }
  Eigen::VectorXd impulses = Eigen::VectorXd::Zero(d.W.rows());
  impulses(rows) = base::least_squares(W, miss);
  v += effect * impulses(rows);
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    const FixedVelocity& f = fixed[i];
    const auto place = static_cast<std::size_t>(f.row);
    const bool both = i + 1 < fixed.size() && d.layout.is_normal(place) &&
                      fixed[i + 1].row == tangent_place(d.layout, d.layout.contact_of(place));
    if (both)
      linear::set_exactly(*f.form, f.value, *fixed[i + 1].form, fixed[i + 1].value, v);
    else
      linear::set_exactly(*f.form, f.value, v);
  }
  return impulses;
}

namespace {

/// Ratio of noise to the largest force above which the forces may not be unique. Noise is 64 times 4 to 8 eps of the terms,
/// times the condition number, so the check begins at condition numbers of about 1e10. Chosen value: it only selects cases for
/// forces_are_unique().
constexpr double suspicious = 1e-3;

bool holds(const Contact& contact, const ContactState& state) {
  if (contact.takes_impulses()) return !state.is_open();
  return contact.sticks_rigidly() && state.state == State::stick;
}

/// Matrix A of forces_are_unique(): rows and columns of W for normals of closed contacts and tangents of sticking contacts. The
/// column for the normal of a slipping contact includes the effect of its friction.
Eigen::MatrixXd constrained_block(const Model& model, const contact::ContactStates& states,
                                  const std::vector<std::size_t>& contacts, const Delassus& d) {
  std::vector<Eigen::Index> rows;
  Eigen::MatrixXd effect = d.W;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& contact = model.contacts[contacts[i]];
    const ContactState& state = states[contacts[i]];
    const Eigen::Index n = normal_place(d.layout, i), t = tangent_place(d.layout, i);
    if (contact.takes_impulses()) rows.push_back(n);
    if (contact.has_friction() && state.state == State::stick) rows.push_back(t);
    if (const int s = slip_sign(state.state); s != 0)
      effect.col(n) -= s * contact::slipping_friction(contact, state.state) * d.W.col(t);
  }
  return effect(rows, rows);
}

/// Adds the entries s Z (D Y)' of linear/redundant_rows.hpp, which make the forces of several feet of one body unique.
void add_sharing_entries(const ForceLayout& layout, const std::vector<linear::SharedForces>& shared,
                         const std::vector<std::size_t>& contacts, Delassus& d) {
  const auto place = [&](std::size_t row) -> std::optional<Eigen::Index> {
    const auto at = std::find(contacts.begin(), contacts.end(), layout.contact_of(row));
    if (at == contacts.end()) return std::nullopt;
    const auto i = at - contacts.begin();
    return layout.is_normal(row) ? normal_place(d.layout, i) : tangent_place(d.layout, i);
  };
  for (const linear::SharedForces& of : shared)
    for (std::size_t i = 0; i < of.rows.size(); ++i)
      for (std::size_t j = 0; j < of.rows.size(); ++j) {
        const auto a = place(of.rows[i]), b = place(of.rows[j]);
        if (a && b) d.W(*a, *b) += of.entries(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      }
}

}  // namespace

bool forces_are_noise(const Model& model, const std::vector<MotionJet>& jets) {
  double noise = 0.0, force = 0.0;
  for (std::size_t c = 0; c < jets.size(); ++c) {
    const ContactMotion& now = jets[c].motion[0];
    force = std::max({force, std::abs(now.N), std::abs(now.T)});
    const Contact& contact = model.contacts[c];
    if (contact.takes_impulses() || contact.sticks_rigidly())
      noise = std::max({noise, jets[c].noise[0].N, jets[c].noise[0].T});
  }
  return noise > suspicious * force;
}

bool forces_are_unique(motion::StateSystems& systems, const contact::ContactStates& states) {
  const Model& model = systems.model();
  std::vector<std::size_t> contacts;
  contact::ContactStates free = states;
  for (std::size_t c = 0; c < states.size(); ++c)
    if (holds(model.contacts[c], states[c])) {
      contacts.push_back(c);
      free[c] = {State::open, 0.0};
    }
  if (contacts.size() < 2) return true;  // the rows of a single contact are linearly independent
  const motion::StateSystemPtr system = systems.system_of(free);
  if (!system) return true;
  Delassus d = delassus(model, *system, contacts);
  if (const motion::StateSystemPtr held = systems.system_of(states))
    add_sharing_entries(model.layout, held->factorised().shared, contacts, d);
  Eigen::MatrixXd a = constrained_block(model, states, contacts, d);
  const Eigen::VectorXd size = a.diagonal().cwiseAbs().cwiseSqrt();
  if (!(size.minCoeff() > 0.0)) return true;  // Painleve's paradox is checked elsewhere
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < a.cols(); ++j) a(i, j) /= size[i] * size[j];
  const Eigen::VectorXd singular = base::singular_values(a);
  return singular.minCoeff() >
         rounding::many_operations * static_cast<double>(a.rows()) * singular.maxCoeff();
}

namespace {

using Kind = CoulombItem::Kind;

/// Forces of items at rest, among which friction and compression may be shared in different ways: rows of these forces, and
/// the admissible set of each item's forces.
struct Shares {
  std::vector<Eigen::Index> rows;
  std::vector<base::ConvexSet> sets;
  std::vector<std::size_t> resting;  ///< items that may stick
};

Shares resting_forces(const CoulombProblem& p, const std::vector<bool>& may_share, const CoulombSolution& s) {
  Shares shares;
  const Eigen::VectorXd size = p.W.cwiseAbs() * s.force.cwiseAbs() + p.b.cwiseAbs();
  const auto rests = [&](Eigen::Index row) {
    return std::abs(s.response[row]) <= rounding::elimination * size[row];
  };
  for (std::size_t i = 0; i < p.items.size(); ++i) {
    const CoulombItem& item = p.items[i];
    const Eigen::Index n = p.normal(i), t = p.tangent(i);
    if (!may_share[i] || item.kind == Kind::limit) continue;
    if (item.kind == Kind::pressed) {
      if (!rests(t) || !(item.applied_normal_force > 0.0)) continue;
      shares.rows.push_back(t);
      shares.sets.push_back(
          {base::ConvexSet::Kind::disc, 1, 0.0, item.static_friction * item.applied_normal_force, {}});
      shares.resting.push_back(i);
      continue;
    }
    if (!rests(n)) continue;
    shares.rows.push_back(n);
    if (item.kind == Kind::normal) {
      shares.sets.push_back({base::ConvexSet::Kind::cone, 1, 0.0, 0.0, {}});
      continue;
    }
    shares.rows.push_back(t);
    if (item.kind == Kind::frictional && rests(t)) {
      shares.sets.push_back({base::ConvexSet::Kind::cone, 2, item.static_friction, 0.0, {}});
      shares.resting.push_back(i);
      continue;
    }
    const double sign = item.kind == Kind::sliding ? item.sign : std::copysign(1.0, s.response[t]);
    Eigen::VectorXd along(2);
    along << 1.0, -sign * item.kinetic_friction;
    shares.sets.push_back({base::ConvexSet::Kind::ray, 2, 0.0, 0.0, along.normalized()});
  }
  return shares;
}

}  // namespace

void min_norm_forces(const CoulombProblem& problem, const std::vector<bool>& may_share,
                     CoulombSolution& solution) {
  const Shares shares = resting_forces(problem, may_share, solution);
  if (shares.rows.size() < 2 || shares.resting.empty()) return;
  const Eigen::MatrixXd open = linear::null_of_columns(problem.W(Eigen::all, shares.rows));  // W f = 0
  if (open.cols() == 0) return;
  const Eigen::VectorXd given = solution.force(shares.rows);
  const Eigen::MatrixXd kept = base::orthogonal_complement(open).transpose();
  const auto force = base::least_norm(kept, kept * given, shares.sets);
  if (!force) return;  // up to rounding, `given` is the only solution
  solution.force(shares.rows) = *force;
  for (const std::size_t i : shares.resting) solution.kinetic[i] = false;
}

}  // namespace signorini::decide
