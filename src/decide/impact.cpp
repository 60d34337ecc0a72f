#include "decide/impact.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "contact/friction.hpp"
#include "contact/motion.hpp"
#include "decide/coulomb_problem.hpp"
#include "decide/delassus.hpp"
#include "model/internal_units.hpp"

namespace signorini::decide {
namespace {

// Energy gains below this fraction of the largest energy term are rounding errors of velocities and impulses. Real gains by
// Newton's law are larger. Chosen value.
constexpr double negligible_gain = 1e-9;

/// The states in which all contacts that take impulses or can stick rigidly are open. The system of equations in these states
/// gives the effect of a single impulse, without reactions at other contacts.
contact::ContactStates released(const Model& model, contact::ContactStates states) {
  for (std::size_t c = 0; c < states.size(); ++c)
    if (const Contact& contact = model.contacts[c]; contact.takes_impulses() || contact.sticks_rigidly())
      states[c] = {State::open, 0.0};
  return states;
}

}  // namespace

Vector ImpactSolver::close_gaps(const contact::ContactStates& states,
                                const std::vector<std::size_t>& touching, Vector u) {
  const motion::StateSystemPtr system = systems_.system_of(released(model_, states));
  if (!system) return u;
  const Delassus d = delassus(model_, *system, touching);
  const auto m = static_cast<Eigen::Index>(touching.size());
  std::vector<Eigen::Index> normals;
  Eigen::VectorXd gap(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const Contact& contact = model_.contacts[touching[static_cast<std::size_t>(i)]];
    gap[i] = contact.gap_at(u);
    normals.push_back(normal_place(d.layout, i));
  }
  const Eigen::MatrixXd W = d.W(normals, normals);
  const Eigen::MatrixXd effect = d.effect(Eigen::all, normals);
  u -= effect * base::least_squares(W, gap);
  for (const std::size_t c : touching)
    linear::set_exactly(model_.contacts[c].normal, -model_.contacts[c].gap, u);
  return u;
}

ImpactSolver::ImpactProblem ImpactSolver::set_up(const motion::Forcing& forcing, double t,
                                                 const motion::StateSystem& system,
                                                 const std::vector<std::size_t>& touching,
                                                 const Vector& v) const {
  const auto m = static_cast<Eigen::Index>(touching.size());
  ImpactProblem hit{delassus(model_, system, touching), {}, {}, {}, {}, Eigen::VectorXd(m), {}, {}};
  const ForceLayout& layout = hit.d.layout;
  hit.before = hit.size = Eigen::VectorXd::Zero(place_count(layout));
  hit.problem.W = hit.d.W;
  hit.problem.layout = layout;
  for (Eigen::Index i = 0; i < m; ++i) {
    const std::size_t c = touching[static_cast<std::size_t>(i)];
    const Contact& contact = model_.contacts[c];
    hit.before[normal_place(layout, i)] = contact::gap_rate(contact, v);
    hit.before[tangent_place(layout, i)] = contact::along_surface(contact, v, forcing.surface(c, t, 1));
    hit.size[normal_place(layout, i)] = contact.normal.magnitude(v);
    hit.size[tangent_place(layout, i)] = contact.tangent.magnitude(v) + std::abs(forcing.surface(c, t, 1));
    hit.restitution[i] = contact.restitution;
    CoulombItem item;
    item.kind = contact.has_friction() ? CoulombItem::Kind::frictional : CoulombItem::Kind::normal;
    item.static_friction = contact::static_friction(contact);
    item.kinetic_friction = contact::kinetic_friction(contact);
    // Friction that rises with the slip rate has, during an impact, the value at the slip rate just before the impact.
    if (contact.friction.is_rate_strengthening())
      item.static_friction = item.kinetic_friction =
          contact::sliding_friction(contact, std::abs(hit.before[tangent_place(layout, i)]));
    hit.problem.items.push_back(item);
  }
  return hit;
}

/// Computes the velocities after the impact. If a contact rebounds slower than capture_velocity, its restitution is set to zero
/// and the impact is computed again. False: there is no solution.
bool ImpactSolver::rebound(const std::vector<std::size_t>& touching, ImpactProblem& hit) const {
  const Eigen::Index m = hit.restitution.size();
  hit.rebound = Eigen::VectorXd::Constant(m, std::numeric_limits<double>::quiet_NaN());
  std::vector<bool> may_share;
  for (const std::size_t c : touching) may_share.push_back(systems_.may_share(c));
  for (bool captured = true; captured;) {  // ends, because each round captures at least one more contact
    captured = false;
    hit.problem.b = hit.before;
    for (Eigen::Index i = 0; i < m; ++i)
      hit.problem.b[normal_place(hit.d.layout, i)] +=
          hit.restitution[i] * std::min(hit.before[normal_place(hit.d.layout, i)], 0.0);
    hit.solution = signorini::decide::solve(hit.problem);
    if (!hit.solution) return false;
    min_norm_forces(hit.problem, may_share, *hit.solution);
    hit.after = hit.before + hit.d.W * hit.solution->force;
    for (Eigen::Index i = 0; i < m; ++i) {
      const Contact& contact = model_.contacts[touching[static_cast<std::size_t>(i)]];
      const double slowest = contact.capture_velocity.value_or(capture_velocity_);
      if (hit.restitution[i] == 0.0 || !(hit.before[normal_place(hit.d.layout, i)] < 0.0)) continue;
      hit.rebound[i] = hit.after[normal_place(hit.d.layout, i)] / slowest;
      if (hit.after[normal_place(hit.d.layout, i)] >= slowest) continue;
      hit.restitution[i] = 0.0;
      captured = true;
    }
  }
  return true;
}

/// Sets velocities of contacts with an impulse to their exact values, without rounding errors: along n to zero or the rebound
/// velocity, along t, if the contact sticks, to the velocity of the surface.
void ImpactSolver::come_to_rest(const motion::Forcing& forcing, double t,
                                const std::vector<std::size_t>& touching, ImpactProblem& hit,
                                Impact& impact) const {
  const CoulombSignificance reading(hit.problem, *hit.solution, rounding::many_operations * hit.size);
  std::vector<FixedVelocity> fixed;
  for (Eigen::Index i = 0; i < hit.restitution.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const std::size_t c = touching[at];
    const Eigen::Index along_n = normal_place(hit.d.layout, i), along_t = tangent_place(hit.d.layout, i);
    if (!(hit.solution->force[along_n] > 0.0)) continue;
    hit.after[along_n] = -hit.restitution[i] * std::min(hit.before[along_n], 0.0);
    fixed.push_back({along_n, &model_.contacts[c].normal, hit.after[along_n]});
    impact.impulses[c].rests = hit.after[along_n] == 0.0;
    if (!model_.contacts[c].has_friction()) continue;
    if (!reading.is_inside_cone(at) && !reading.is_zero_response(along_t)) continue;
    hit.after[along_t] = 0.0;
    fixed.push_back({along_t, &model_.contacts[c].tangent, forcing.surface(c, t, 1)});
    impact.impulses[c].sticks = true;
  }
  impact.correction_impulses = impose_velocities(hit.d, fixed, impact.v);
}

/// Computes the impulse of each contact, the dissipated energy, and the work of moving surfaces.
void ImpactSolver::balance(const motion::Forcing& forcing, double t, const contact::ContactStates& states,
                           const std::vector<std::size_t>& touching, const ImpactProblem& hit,
                           Impact& impact) const {
  double greatest = 0.0;
  for (Eigen::Index i = 0; i < hit.restitution.size(); ++i) {
    const std::size_t c = touching[static_cast<std::size_t>(i)];
    const double n = hit.solution->force[normal_place(hit.d.layout, i)],
                 k = hit.solution->force[tangent_place(hit.d.layout, i)];
    Impulse& impulse = impact.impulses[c];
    impulse.hit = n > 0.0 && states[c].is_open();
    impulse.normal = n;
    impulse.tangent = k;
    impulse.rebound = hit.rebound[i];
    const double normal =
        0.5 * n * (hit.before[normal_place(hit.d.layout, i)] + hit.after[normal_place(hit.d.layout, i)]);
    const double tangent =
        0.5 * k * (hit.before[tangent_place(hit.d.layout, i)] + hit.after[tangent_place(hit.d.layout, i)]);
    impact.loss -= normal + tangent;
    impact.surface_work += k * forcing.surface(c, t, 1);
    greatest = std::max({greatest, std::abs(n * hit.before[normal_place(hit.d.layout, i)]),
                         std::abs(k * hit.before[tangent_place(hit.d.layout, i)])});
  }
  impact.gains = impact.loss < -negligible_gain * greatest;
}

Impact ImpactSolver::solve(const motion::Forcing& forcing, double t, const contact::ContactStates& states,
                           const std::vector<std::size_t>& touching, const Vector& v) {
  Impact impact;
  impact.v = v;
  impact.impulses.resize(model_.contacts.size());
  const motion::StateSystemPtr system = systems_.system_of(released(model_, states));
  if (!system) {
    impact.refusal = {Refusal::Kind::singular, "the mass matrix is singular", touching};
    return impact;
  }
  ImpactProblem hit = set_up(forcing, t, *system, touching, v);
  if (!rebound(touching, hit)) {
    impact.refusal = {Refusal::Kind::impact,
                      "the impact has no solution: Lemke's method for its complementarity problem ends "
                      "in a ray",
                      touching, condition_number(hit.problem)};
    const double shown = model::in_scene_units(model_, 1.0, unit::velocity);
    for (std::size_t i = 0; i < touching.size(); ++i) {
      const Eigen::Index n = normal_place(hit.d.layout, i);
      impact.refusal.reason +=
          fmt::format("; '{}': vn = {:.6g}, vt = {:.6g}", model_.contacts[touching[i]].name,
                      hit.before[n] * shown, hit.before[tangent_place(hit.d.layout, i)] * shown);
    }
    return impact;
  }
  impact.v += hit.d.effect * hit.solution->force;
  come_to_rest(forcing, t, touching, hit, impact);
  balance(forcing, t, states, touching, hit, impact);
  return impact;
}

contact::ContactStates states_of_impact(const Model& model, contact::ContactStates states,
                                        const std::vector<Impulse>& impulses) {
  for (std::size_t c = 0; c < states.size(); ++c) {
    const Contact& contact = model.contacts[c];
    if (!contact.takes_impulses() && !contact.sticks_rigidly()) continue;
    states[c] = {State::open, 0.0};
    const Impulse& impulse = impulses[c];
    if (!(impulse.normal > 0.0)) continue;
    if (!contact.has_friction())
      states[c].state = State::closed;
    else if (impulse.sticks)
      states[c].state = State::stick;
    else
      states[c].state = impulse.tangent > 0.0 ? State::slip_minus : State::slip_plus;
  }
  return states;
}

std::vector<std::size_t> next_impact(std::vector<Approach>& all) {
  double soonest = std::numeric_limits<double>::infinity();
  for (const Approach& a : all)
    if (a.is_closing()) soonest = std::min(soonest, a.gap / -a.rate);
  std::vector<std::size_t> struck;
  if (soonest == std::numeric_limits<double>::infinity()) return struck;
  for (Approach& a : all) {
    const bool rests = a.gap == 0.0 && a.rate <= a.rest;
    const double gap = rests ? 0.0 : a.gap + a.rate * soonest;
    a.gap = gap > rounding::few_operations * a.gap ? gap : 0.0;  // 0 within the rounding error
    if (a.gap == 0.0 && (a.is_closing() || a.rate <= a.rest)) struck.push_back(a.contact);
  }
  return struck;
}

}  // namespace signorini::decide
