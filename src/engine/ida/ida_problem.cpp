#include "engine/ida/ida_problem.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "base/simd.hpp"
#include "contact/curved_surface.hpp"
#include "contact/friction.hpp"
#include "engine/ida/restart_order.hpp"
#include "motion/point.hpp"

namespace signorini::ida {
namespace {

// Largest error of one step, as a fraction of the requested tolerance. IDA's error test bounds the error of one step, but the
// errors of thousands of steps add up. Measured on the reference cases: with this fraction instead of 1, the sum over a hundred
// oscillations is at most a few hundred tolerances, and the number of steps is 1.3 times as large.
constexpr double local_part = 0.2;
// Smallest tolerance of a force, relative to the terms whose difference is the force: a tolerance below the rounding error of
// kn g cannot be met. Chosen; the smallest admissible rtol, 1e-13, depends on this value (docs/theory.md, Limits).
constexpr double rounding_floor = 20.0 * rounding::eps;
// Factor on rounding_floor for T of a shear element in series with rate-dependent friction: T has the rounding errors of ut - p
// and of ut' - p', and Newton's method must converge to a thousandth of the tolerance (sharp_newton in bdf_integrator.cpp).
constexpr double newton_rounding_factor = 100.0;

/// Computes r = yp - v and u = y - step r.
SIGNORINI_WIDE_LANES void shift_back(std::size_t n, double step, const double* y, const double* v,
                                     const double* yp, double* r, double* u) {
  std::size_t i = 0;
  for (; i + 3 < n; i += 4) {
    const base::Double4 off =
        base::lanes_at<base::Double4>(yp + i).v - base::lanes_at<base::Double4>(v + i).v;
    base::lanes_at<base::Double4>(r + i).v = off;
    base::lanes_at<base::Double4>(u + i).v = base::lanes_at<base::Double4>(y + i).v - step * off;
  }
  for (; i < n; ++i) {
    r[i] = yp[i] - v[i];
    u[i] = y[i] - step * r[i];
  }
}

/// Computes the weights w = factor / (rtol |y| + atol).
SIGNORINI_WIDE_LANES void weigh(std::size_t n, double rtol, const double* factor, const double* atol,
                                const double* y, double* w) {
  std::size_t i = 0;
  for (; i + 3 < n; i += 4) {
    const base::Double4 size = base::lanes_at<base::Double4>(y + i).v < 0.0
                                   ? -base::lanes_at<base::Double4>(y + i).v
                                   : base::lanes_at<base::Double4>(y + i).v;
    base::lanes_at<base::Double4>(w + i).v = base::lanes_at<base::Double4>(factor + i).v /
                                             (rtol * size + base::lanes_at<base::Double4>(atol + i).v);
  }
  for (; i < n; ++i) w[i] = factor[i] / (rtol * std::abs(y[i]) + atol[i]);
}

}  // namespace

IdaProblem::IdaProblem(const Model& model, const linear::SystemMatrices& structure,
                       const engine::Tolerance& tolerance)
    : model_(model),
      structure_(structure),
      layout_(model),
      linear_(model, structure, layout_),
      tolerance_(tolerance),
      structural_forces_(model, structure),
      forces_(layout_.massive < layout_.dofs ? static_cast<std::size_t>(layout_.dofs) : 0),
      u_(static_cast<std::size_t>(layout_.dofs)) {
  const auto size = static_cast<std::size_t>(layout_.size());
  atol_.assign(size, tolerance.force);
  for (std::size_t place = 0; place < model.layout.size(); ++place)
    if (!model.layout.is_used(place)) unused_.push_back(layout_.force(place));
  std::vector<std::size_t> group(size, 2 * model.contacts.size());
  for (std::size_t i = 0; i < model.dofs.size(); ++i) {
    const bool rotation = model.dofs[i].rotation;
    atol_[i] = rotation ? tolerance.rotation : tolerance.displacement;
    if (layout_.velocity[i] >= 0)
      atol_[static_cast<std::size_t>(layout_.velocity[i])] =
          rotation ? tolerance.angular_velocity : tolerance.velocity;
  }
  for (std::size_t k = model.contacts.size(); k-- > 0;) {
    for (const int f : {layout_.normal(k), layout_.tangent(k)}) group[static_cast<std::size_t>(f)] = 2 * k;
    for (const Combination* form : {&model.contacts[k].normal, &model.contacts[k].tangent})
      for (const auto& term : form->terms) {
        const auto i = static_cast<std::size_t>(term.first);
        group[i] = 2 * k + 1;
        if (layout_.velocity[i] >= 0) group[static_cast<std::size_t>(layout_.velocity[i])] = 2 * k + 1;
      }
  }
  std::vector<double> members(2 * model.contacts.size() + 1, 0.0);
  for (std::size_t g : group) members[g] += 1.0;
  for (std::size_t i = 0; i < size; ++i)
    factor_.push_back(std::sqrt(static_cast<double>(size) / members[group[i]]) / local_part);
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& contact = model.contacts[k];
    if (contact.takes_impulses()) add_stopped_mass(contact.normal, layout_.normal(k));
    if (contact.takes_impulses() || contact.sticks_rigidly())
      add_stopped_mass(contact.tangent, layout_.tangent(k));
  }
  for (int i = 0; i < layout_.dofs; ++i) {
    if (layout_.velocity[static_cast<std::size_t>(i)] >= 0) continue;
    Massless own{i, model.stiffness.coeff(i, i), {}};
    for (std::size_t k = 0; k < model.contacts.size(); ++k) {
      const Contact& contact = model.contacts[k];
      const auto carry = [&](const Combination& form, int force, double stiffness) {
        for (const auto& [dof, factor] : form.terms) {
          if (dof != i) continue;
          own.stiffness += factor * factor * stiffness;
          own.forces.emplace_back(force, std::abs(factor));
        }
      };
      carry(contact.normal, layout_.normal(k), contact.normal_stiffness);
      carry(contact.tangent, layout_.tangent(k), contact.tangential_stiffness.value_or(0.0));
    }
    if (own.stiffness > 0.0) massless_.push_back(std::move(own));
  }
}

void IdaProblem::add_stopped_mass(const Combination& form, int force) {
  double compliance = 0.0;
  for (const auto& [dof, factor] : form.terms)
    if (const double mass = model_.mass.coeff(dof, dof); mass > 0.0) compliance += factor * factor / mass;
  if (compliance > 0.0) stopped_masses_.push_back({&form, force, 1.0 / compliance});
}

void IdaProblem::start(const engine::Segment& segment, const events::GuardMonitor& watch) {
  segment_ = segment;
  guard_monitor_ = &watch;
  linear_.set_contact_states(segment.decision->states);
  shared_ = linear_.shared_rows().in_force(linear_.rows());
  list_watched_guards();
  nonlinear_.clear();
  for (std::size_t k = 0; k < model_.contacts.size(); ++k)
    if (contact::slips_nonlinearly(model_.contacts[k], segment.decision->states[k].state))
      nonlinear_.push_back(k);
  rate_dependent_ = std::any_of(nonlinear_.begin(), nonlinear_.end(), [&](std::size_t k) {
    return model_.contacts[k].friction.is_rate_strengthening();
  });
}

void IdaProblem::linearise(double t, const double* y, const double* yp) {
  for (const std::size_t k : nonlinear_)
    linear_.linearise(
        k, contact::sliding_row_tangent(model_.contacts[k], slip_sign(segment_.decision->states[k].state),
                                        motion(k, t, y, yp)));
}

ContactMotion IdaProblem::motion(std::size_t k, double t, const double* y, const double* yp,
                                 double step) const {
  const Contact& contact = model_.contacts[k];
  const motion::Forcing& forcing = *segment_.forcing;
  ContactMotion m;
  const double N = y[layout_.normal(k)], T = y[layout_.tangent(k)];
  m.N = N;
  m.T = T;
  contact::set_displacement(contact, y, forcing.surface(k, t, 0), m);
  if (step != 0.0) {
    const auto off = by_dof([&](std::size_t i, int v) { return v >= 0 ? yp[i] - y[v] : 0.0; });
    m.gap -= step * contact.normal.dot(off);
    m.ut -= step * contact.tangent.dot(off);
  }
  const auto velocity = by_dof([&](std::size_t i, int v) { return v >= 0 ? y[v] : yp[i]; });
  contact::set_velocity(contact, velocity, forcing.surface(k, t, 1), m);
  const Rows& rows = linear_.rows()[k];
  if (rows.normal.an != 0.0 || rows.tangent.at != 0.0) {
    const auto acceleration = by_dof([&](std::size_t, int v) { return v >= 0 ? yp[v] : 0.0; });
    contact::set_acceleration(contact, acceleration, forcing.surface(k, t, 2), m);
  }
  if (contact.normal_force_given()) {
    m.applied_normal_force = forcing.applied_normal_force(k, t, 0);
    m.applied_normal_force_rate = forcing.applied_normal_force(k, t, 1);
  }
  contact::set_limit(contact, m);
  return m;
}

ContactMotion IdaProblem::change(std::size_t k, const double* of) const {
  const Contact& contact = model_.contacts[k];
  const auto velocity = by_dof([&](std::size_t, int v) { return v >= 0 ? of[v] : 0.0; });
  ContactMotion m;
  m.N = of[layout_.normal(k)];
  m.T = of[layout_.tangent(k)];
  m.gap = contact.normal.dot(of);
  m.ut = contact.tangent.dot(of);
  m.vn = contact.normal.dot(velocity);
  m.vt = contact.tangent.dot(velocity);
  return m;
}

/// Adds s z z^T f for directions z in which contact forces f have no effect (linear/redundant_rows.hpp). Without this term, IDA
/// would extrapolate the component of f along z from step to step, and the error of this component would grow.
void IdaProblem::add_shared(const double* y, double* r) const {
  for (const linear::SharedForces& shared : shared_)
    for (std::size_t i = 0; i < shared.rows.size(); ++i)
      for (std::size_t j = 0; j < shared.rows.size(); ++j)
        r[layout_.force(shared.rows[i])] +=
            shared.entries(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) *
            y[layout_.force(shared.rows[j])];
}

void IdaProblem::residual(double t, double step, const double* y, const double* yp, double* r) {
  const auto n = static_cast<std::size_t>(layout_.dofs);
  const bool all_massive = layout_.massive == layout_.dofs;
  double* forces = all_massive ? r + n : forces_.data();
  if (all_massive) {
    const double *v = y + n, *a = yp + n;
    shift_back(n, step, y, v, yp, r, u_.data());
    for (std::size_t i = 0; i < n; ++i) structural_forces_.put(i, a[i], v[i], u_[i]);
  } else {
    for (std::size_t i = 0; i < n; ++i) {
      const int v = layout_.velocity[i];
      if (v >= 0)
        structural_forces_.put(i, yp[v], y[v], y[i] - step * (yp[i] - y[v]));
      else
        structural_forces_.put(i, 0.0, yp[i], y[i]);
    }
  }
  structural_forces_.apply(forces);
  segment_.forcing->add_load(t, 0, forces, -1.0);
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const int in_N = layout_.normal(k), in_T = layout_.tangent(k);
    model_.contacts[k].normal.add_to(forces, y[in_N]);
    model_.contacts[k].tangent.add_to(forces, y[in_T]);
    const ContactMotion m = motion(k, t, y, yp, step);
    if (const Contact& contact = model_.contacts[k]; contact.curved_surface())
      contact.body_tangent().add_to(
          forces, contact::restoring_force(
                      contact, y[in_N], contact.body_tangent().dot(y) - segment_.forcing->surface(k, t, 0)));
    r[in_N] = linear_.rows()[k].normal.value(m);
    r[in_T] = linear_.rows()[k].tangent.value(m);
  }
  for (const int place : unused_) r[place] = y[place];
  add_shared(y, r);
  for (std::size_t i = 0; i < n && !all_massive; ++i) {
    const int v = layout_.velocity[i];
    r[v >= 0 ? static_cast<std::size_t>(v) : i] = forces[i];
    if (v >= 0) r[i] = yp[i] - y[v];
  }
  for (const std::size_t k : nonlinear_) {
    const int s = slip_sign(segment_.decision->states[k].state);
    r[layout_.tangent(k)] = contact::sliding_row_value(model_.contacts[k], s, motion(k, t, y, yp));
  }
}

void IdaProblem::weights(const double* y, double rate, double* w) const {
  weigh(atol_.size(), tolerance_.rtol, factor_.data(), atol_.data(), y, w);
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    // N = kn g and T = kt (ut - p) are differences of large numbers: a tolerance below their rounding cannot be met.
    const Contact& contact = model_.contacts[k];
    const double gap = std::abs(contact.gap) + contact.normal.magnitude(y);
    const double surface = segment_.forcing->surface(k, segment_.decision->jet.t, 0);
    const double ut = std::abs(surface) + contact.tangent.magnitude(y);
    const auto limit = [&](int force, double magnitude) {
      const auto i = static_cast<std::size_t>(force);
      const double rounding = rounding_floor * magnitude;
      if (rounding * w[i] > factor_[i]) w[i] = factor_[i] / rounding;
    };
    limit(layout_.normal(k), contact.normal_stiffness * gap);
    limit(layout_.tangent(k), contact.tangential_stiffness.value_or(0.0) * ut);
    if (contact.sliding_point() && contact.friction.is_rate_strengthening()) {
      const ShearElement& element = *contact.sliding_point();
      limit(layout_.tangent(k), newton_rounding_factor * (element.stiffness + element.damping * rate) *
                                    (element.body.magnitude(y) + contact.tangent.magnitude(y)));
    }
  }
  for (const StoppedMass& stop : stopped_masses_) {
    const auto i = static_cast<std::size_t>(stop.force);
    const auto velocity = by_dof([&](std::size_t, int v) { return v >= 0 ? y[v] : 0.0; });
    const double rounding = rounding_floor * stop.mass * rate * stop.form->magnitude(velocity);
    if (rounding * w[i] > factor_[i]) w[i] = factor_[i] / rounding;
  }
  widen_massless(y, w);
}

void IdaProblem::widen_massless(const double* y, double* w) const {
  const auto limit = [&](int index, double rounding) {
    const auto i = static_cast<std::size_t>(index);
    if (rounding * w[i] > factor_[i]) w[i] = factor_[i] / rounding;
  };
  // All massless degrees of freedom have the same tolerance, because contacts and rows propagate rounding errors. Rotations and
  // displacements are comparable, because the internal unit of length is the extent of the structure.
  double length = 0.0, greatest = 0.0;
  for (const Massless& own : massless_) {
    double force = 0.0;
    for (SparseMatrix::InnerIterator it(model_.stiffness, own.dof); it; ++it)
      force += std::abs(it.value() * y[it.row()]);
    greatest = std::max(greatest, force);
    length = std::max(length, force / own.stiffness);
  }
  const double part = rounding::many_operations / local_part;
  for (const Massless& own : massless_) {
    limit(own.dof, part * length);
    for (const auto& [unknown, factor] : own.forces) limit(unknown, part * factor * greatest);
  }
}

void IdaProblem::list_watched_guards() {
  const Scales& scale = model_.scales;
  watched_guards_.clear();
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const decide::GuardsOfState& forms = segment_.decision->forms[k];
    for (std::size_t i = 0; i < layout_.contacts.guards(k); ++i) {
      const std::size_t slot = layout_.contacts.guard(k, i);
      const Guard kind = segment_.decision->guards[slot].kind;
      // IDA does not interpolate accelerations, so guards that contain one are left to events::GuardMonitor::check().
      if (kind == Guard::none || forms[i].any_form([](const Form& form) { return form.an != 0.0; })) continue;
      // Guards are scaled to order 1, so that IDA's products of guard values do not underflow.
      const bool of_rate = kind == Guard::sliding && forms[i].form.T == 0.0;
      const double unit = kind == Guard::closing ? scale.displacement
                          : of_rate              ? scale.velocity
                                                 : scale.force;
      watched_guards_.push_back({k, slot, &forms[i], decide::QuickForm(forms[i].form), unit});
    }
  }
}

void IdaProblem::guards(double t, const double* y, const double* yp, double* g) const {
  std::fill(g, g + slots(), 1.0);
  std::size_t evaluated = model_.contacts.size();  // contact of m
  ContactMotion m;
  for (const WatchedGuard& watched : watched_guards_) {
    if (!guard_monitor_->armed(watched.slot)) continue;
    if (watched.contact != evaluated) m = motion(evaluated = watched.contact, t, y, yp);
    const GuardForm& guard = *watched.guard;
    g[watched.slot] = guard.is_linear()
                          ? watched.form.value(m) / watched.unit
                          : guard.value(m) * tolerance_.rtol / engine::tolerance(guard, m, tolerance_);
  }
}

void IdaProblem::fill(const motion::Jet& jet, std::size_t order, double* y) const {
  const auto o = static_cast<Eigen::Index>(order);
  for (std::size_t i = 0; i < static_cast<std::size_t>(layout_.dofs); ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    y[i] = jet.u(e, o);
    if (layout_.velocity[i] >= 0) y[layout_.velocity[i]] = jet.u(e, o + 1);
  }
  for (Eigen::Index i = 0; i < jet.forces.rows(); ++i)
    y[layout_.force(static_cast<std::size_t>(i))] = jet.forces(i, o);
}

void IdaProblem::evaluate_jet(const motion::Jet& jet, double x, int derivative, double* y) const {
  const Eigen::Index p = derivative, n = layout_.dofs;
  const auto is_massless = [&](Eigen::Index i) { return layout_.velocity[static_cast<std::size_t>(i)] < 0; };
  const bool massless = layout_.massive < layout_.dofs;
  displacement_derivatives(jet, p, x, massless, is_massless, Eigen::Map<Vector>(y, n));
  Vector rates(n);
  displacement_derivatives(jet, p + 1, x, massless, is_massless, rates);
  for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i)
    if (const int v = layout_.velocity[i]; v >= 0) y[v] = rates[static_cast<Eigen::Index>(i)];
  Vector forces(jet.forces.rows());
  taylor_derivatives(jet.forces, motion::Jet::orders, p, x, forces);
  for (Eigen::Index i = 0; i < forces.size(); ++i) y[layout_.force(static_cast<std::size_t>(i))] = forces[i];
}

double IdaProblem::imbalance(double t, const double* y, const double* yp) const {
  motion::Point point;
  read(y, yp, point);
  point.a.setZero(layout_.dofs);
  for (Eigen::Index i = 0; i < point.a.size(); ++i)
    if (const int v = layout_.velocity[static_cast<std::size_t>(i)]; v >= 0) point.a[i] = yp[v];
  return signorini::motion::equilibrium_residual(model_, structure_, *segment_.forcing, t, point);
}

void IdaProblem::read(const double* y, const double* yp, motion::Point& point) const {
  const auto n = static_cast<Eigen::Index>(layout_.dofs);
  point.u = Eigen::Map<const Vector>(y, n);
  point.v.resize(n);
  if (layout_.massive == layout_.dofs)
    point.v = Eigen::Map<const Vector>(y + n, n);
  else
    for (Eigen::Index i = 0; i < n; ++i) {
      const int v = layout_.velocity[static_cast<std::size_t>(i)];
      point.v[i] = v >= 0 ? y[v] : yp[i];
    }
  point.forces = Eigen::Map<const Vector>(y + layout_.force(0), layout_.forces);
}

}  // namespace signorini::ida
