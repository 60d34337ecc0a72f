#include "decide/contact_state_solver.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "decide/coulomb_problem.hpp"
#include "decide/cycle_fallback.hpp"
#include "decide/delassus.hpp"
#include "decide/driven_states.hpp"
#include "decide/guard_signs.hpp"
#include "decide/massless_jump.hpp"
#include "motion/state_systems.hpp"

namespace signorini::decide {
namespace {

/// A guard and its time derivatives at the zero of the guard, from the motion just before the change of state.
Crossing crossing(const GuardForm& guard, const MotionJet& jet) {
  Crossing result{guard, {}, guard.rounding(jet.motion.data(), jet.noise.data(), 0)};
  for (std::size_t k = 1; k < jet.motion.size(); ++k)
    result.derivatives[k - 1] = guard.derivative(jet.motion.data(), k);
  return result;
}

std::vector<std::size_t> indices_of_all_contacts(const Model& model) {
  std::vector<std::size_t> all(model.contacts.size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

/// Refusal for contact states whose equations have no unique solution: constraint rows of contacts are linearly dependent, or
/// the matrix of the structure is singular.
Refusal unsolvable_refusal(const Model& model, const contact::ContactStates& states) {
  std::vector<std::size_t> held;
  for (std::size_t c = 0; c < states.size(); ++c)
    if (!states[c].is_open() && (model.contacts[c].takes_impulses() || model.contacts[c].sticks_rigidly()))
      held.push_back(c);
  if (!held.empty()) {
    Refusal why = dependent_rows(held);
    for (const std::size_t c : held)
      if (const std::string alone = massless_stick_error(model, model.contacts[c]); !alone.empty()) {
        why.reason += ": " + alone;
        break;
      }
    return why;
  }
  return {Refusal::Kind::singular,
          "the equations of motion are singular: the smallest stiffness or mass is below the rounding error "
          "of the largest one, or outside the range of doubles",
          {}};
}

/// Keys that make the forces of these contacts unique, for messages. Only sliders may have a tangential_stiffness without a
/// normal_stiffness.
std::string springs_for_uniqueness(const Model& model, const std::vector<std::size_t>& contacts) {
  const auto sliders = std::count_if(contacts.begin(), contacts.end(),
                                     [&](std::size_t k) { return model.contacts[k].normal_force_given(); });
  if (sliders == 0) return "law = \"compliant\"";
  return sliders < static_cast<std::ptrdiff_t>(contacts.size())
             ? "law = \"compliant\" (for sliders a tangential_stiffness)"
             : "a tangential_stiffness";
}

}  // namespace

ContactStateSolver::ContactStateSolver(motion::StateSystems& systems, int max_rounds, double capture_velocity,
                                       bool whole_jets)
    : model_(systems.model()),
      systems_(systems),
      jets_(systems),
      all_contacts_(indices_of_all_contacts(model_)),
      max_rounds_(max_rounds),
      rigid_solver_(systems, jets_, capture_velocity),
      guards_(model_),
      blocks_(model_),
      cycle_fallback_(systems, jets_, blocks_) {
  const std::size_t rigid = blocks_.max_rigid(model_);
  decide_separately_ = rigid <= 1;
  if (whole_jets || rigid > 0) return;
  local_derivatives_.emplace(systems);
  if (!local_derivatives_->possible()) local_derivatives_.reset();
}

/// Computes the motion in the given contact states. False: the constraint rows of these states are linearly dependent.
bool ContactStateSolver::evaluate(const motion::Forcing& forcing, contact::ContactStates& states,
                                  SolverState& solver_state) {
  systems_.mark_static_limits(states, forcing, solver_state.instant.t);
  Decision& d = solver_state.decision;
  const Instant& instant = solver_state.instant;
  d.system = systems_.system_of(states);
  if (!d.system) return false;
  d.u = instant.u;
  d.v = instant.v;
  solver_state.held = local_derivatives_
                          ? Eigen::VectorXd()
                          : motion::project_constraints(model_, *d.system, forcing, instant.t, d.u, d.v);
  motion::JetMaker::StopCriterion enough;
  if (decide_separately_ && !solver_state.impact_result.sliders)
    enough = [&](std::size_t c, const MotionJet& jet, std::size_t orders) {
      return signs_are_decided(guards_.of(c, states[c]), c, jet, orders, instant,
                               solver_state.impact_result.known[c], retry_noise_factor);
    };
  std::optional<motion::LocalDerivatives::LocalJet> near;
  if (local_derivatives_) {
    const bool same = solver_state.open && solver_state.forcing == &forcing &&
                      solver_state.noise_factor == instant.noise_factor && d.u == d.jet.u.col(0) &&
                      d.v == d.jet.u.col(1);
    near = local_derivatives_->make(
        d.system, forcing, instant.t, d.u, d.v, solver_state.jets, enough,
        same ? std::optional<motion::LocalDerivatives::PreviousJet>({d.jet, *solver_state.open})
             : std::nullopt);
    solver_state.forcing = &forcing;
    solver_state.noise_factor = instant.noise_factor;
  }
  solver_state.open.reset();
  if (near) {
    d.jet = std::move(near->jet);
    solver_state.open = std::move(near->open);
  } else {
    d.jet = jets_.make(d.system, forcing, instant.t, d.u, d.v, solver_state.jets, enough);
  }
  d.u = d.jet.u.col(0);
  d.v = d.jet.u.col(1);
  d.states = states;
  return !forces_are_noise(model_, solver_state.jets) || forces_are_unique(systems_, states);
}

std::vector<motion::BodySlide> ContactStateSolver::slides(const motion::Forcing& forcing,
                                                          const Decision& decision) const {
  std::vector<motion::BodySlide> result;
  result.reserve(model_.contacts.size());
  for (std::size_t k = 0; k < model_.contacts.size(); ++k)
    result.push_back(
        motion::body_slide(model_.contacts[k], k, forcing, decision.jet.t, decision.u, decision.v));
  return result;
}

/// Computes the motion just before the instant, with the old states and the old forcing. If the forcing jumps, also computes
/// the states that follow from the jump.
Refusal ContactStateSolver::begin(const motion::Forcing& before, SolverState& solver_state) {
  Instant& instant = solver_state.instant;
  Decision& d = solver_state.decision;
  if (!evaluate(before, instant.states, solver_state)) return unsolvable_refusal(model_, instant.states);
  d.before.reserve(solver_state.jets.size());
  solver_state.noise_before.reserve(solver_state.jets.size());
  for (const MotionJet& jet : solver_state.jets) {
    d.before.push_back(jet.motion[0]);
    solver_state.noise_before.push_back(jet.noise[0]);
  }
  if (!instant.resting_limits.empty()) solver_state.motion_up_to_instant = solver_state.jets;
  d.slides_before = slides(before, d);
  // Removes the drift of the integration from u and v: a rigidly sticking contact moves with its surface, and a touching
  // rigid contact has no gap. The drift must not influence the decision.
  if (instant.start) solver_state.initial_u = instant.u;
  instant.u = d.u;
  instant.v = d.v;
  solver_state.impact_result.capture(std::exchange(solver_state.held, {}));
  solver_state.states = instant.states;
  if (!instant.jump) return {};
  apply_forcing_jump(model_, instant, before, solver_state.after, d.before, solver_state.states);
  do {  // ends, because each round makes one more contact stick
    if (!evaluate(solver_state.after, solver_state.states, solver_state))
      return unsolvable_refusal(model_, solver_state.states);
  } while (resolve_slip_reversal(model_, d.before, solver_state.jets, solver_state.states));
  return {};
}

bool ContactStateSolver::held_by_others(std::size_t c, const SolverState& solver_state) const {
  return systems_.may_share(c) &&
         systems_.held_by_others(c, solver_state.states, solver_state.after, solver_state.instant.t);
}

/// True if other contacts keep the slip rate or the gap of this guard at zero: the guard is then omitted.
bool ContactStateSolver::guard_is_kept_at_zero(std::size_t c, Guard guard,
                                               const SolverState& solver_state) const {
  if (guard == Guard::sliding) return held_by_others(c, solver_state);
  return guard == Guard::closing && solver_state.states[c].is_open() &&
         is_held_at_zero_gap(systems_, c, solver_state.states, solver_state.decision.u);
}

/// Adds the feet at rest that the loop has released (run/foot_releases.hpp): the states of their body are decided again.
void ContactStateSolver::add_released(SolverState& solver_state) const {
  const std::vector<std::size_t> failed = contacts_of(solver_state.failed);
  for (const TriggeredGuard& f : solver_state.instant.triggered)
    if (std::find(failed.begin(), failed.end(), f.contact) == failed.end() &&
        guard_is_kept_at_zero(f.contact, f.guard, solver_state))
      solver_state.failed.push_back({f.contact, f.guard, {}, {-1, 1, 1.0}});
}

/// Finds the guards that fail in the evaluated states, and calls the listener. before: true if the evaluated states are the
/// states before the instant.
void ContactStateSolver::check_guards(SolverState& solver_state, bool before) {
  solver_state.failed =
      find_failed_guards(model_, solver_state.jets, solver_state.states, solver_state.instant, before,
                         solver_state.impact_result.known, solver_state.motion_up_to_instant,
                         solver_state.open ? *solver_state.open : all_contacts_);
  std::erase_if(solver_state.failed, [&](const FailedGuard& f) {
    if (guard_is_kept_at_zero(f.contact, f.guard, solver_state)) return true;
    return std::find(solver_state.undecided.begin(), solver_state.undecided.end(), blocks_.of[f.contact]) !=
           solver_state.undecided.end();
  });
  if (!listener_) return;
  DecisionRound round{solver_state.instant.t,         solver_state.decision.rounds, {}, {},
                      solver_state.impact_result.hit, solver_state.states,          {}};
  for (const TriggeredGuard& f : solver_state.instant.triggered)
    round.triggered.push_back({f.contact, contact::to_string(f.guard)});
  for (const FailedGuard& f : solver_state.failed)
    round.failed.push_back({f.contact, contact::to_string(f.guard), f.sign.order, f.sign.excess});
  for (std::size_t c = 0; c < solver_state.impact_result.known.size(); ++c)
    if (solver_state.impact_result.known[c].touches) round.touching.push_back(c);
  listener_(round);
}

/// If the contact of f stops slipping at the end of the instantaneous motion of massless parts, a new motion of these parts
/// starts at the stop, so that the contact sticks at this position. Done at most once per contact, because the path changes.
void ContactStateSolver::restart_path_at_stop(const FailedGuard& f, SolverState& solver_state) const {
  std::vector<std::size_t>& before = solver_state.stopped_on_path;
  if (!stops_on_path(model_.contacts[f.contact], f, solver_state.states[f.contact].state,
                     {solver_state.instant.u, solver_state.decision.u},
                     solver_state.jets[f.contact].noise[0].ut) ||
      std::find(before.begin(), before.end(), f.contact) != before.end())
    return;
  before.push_back(f.contact);
  solver_state.instant.u = solver_state.decision.u;
  solver_state.tried_states.clear();
}

namespace {

bool lands_on_dashpot(const Model& model, const PathTouch& touch) {
  return std::any_of(touch.landings.begin(), touch.landings.end(), [&](const PathTouch::Landing& landing) {
    return model.contacts[landing.contact].normal_damping > 0.0;
  });
}

std::vector<Block> selected(const std::vector<Block>& blocks, const std::vector<bool>& mask) {
  std::vector<Block> result;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    if (mask[b]) result.push_back(blocks[b]);
  return result;
}

}  // namespace

/// Sets the next states of the contacts that are decided separately. Returns the blocks of contacts that must be decided
/// together.
std::vector<Block> ContactStateSolver::decide_separate_contacts(SolverState& solver_state) const {
  ImpactResult& found = solver_state.impact_result;
  std::vector<bool> jointly(blocks_.all.size(), false);
  std::vector<std::size_t> turning;
  const MasslessPath way{solver_state.jump_origin(), solver_state.decision.u};
  solver_state.touched = first_touch(model_, way, solver_state.failed);
  const auto touched = [&touch = solver_state.touched](std::size_t c) {
    return touch ? touch->of(c) : nullptr;
  };
  if (solver_state.touched && lands_on_dashpot(model_, *solver_state.touched))
    solver_state.instant.u = way.from + solver_state.touched->fraction * (way.to - way.from);
  // Failures are deferred only until states repeat; afterwards all contacts are decided.
  if (solver_state.decision.rounds >= 2 && !solver_state.noise_increased) {
    defer_slip_failures(model_, solver_state.failed);
    if (!found.sliders)
      defer_pushed_failures(model_, solver_state.decision.visited, blocks_.of, solver_state.failed);
  }
  for (const FailedGuard& f : solver_state.failed) {
    const std::size_t c = f.contact;
    const Contact& contact = model_.contacts[c];
    // A contact that closes during an instantaneous motion has no crossing: another contact caused the event.
    if (!solver_state.decision.visited[c] && touched(c) == nullptr &&
        !is_pushed(f, solver_state.instant, solver_state.decision.before[c], solver_state.noise_before[c]))
      solver_state.decision.crossings.insert_or_assign(c, crossing(f.form, solver_state.jets[c]));
    solver_state.decision.visited[c] = true;
    if (found.sliders) jointly[blocks_.of[c]] = true;
    const bool slips = contact::is_friction_limit(f.guard);
    const bool joins = contact.sticks_rigidly() && (found.sliders || systems_.may_share(c));
    if (!contact.takes_impulses() && !joins) {
      // The slip rate of this contact is zero up to rounding, so the slip rate is treated as zero in any next state.
      if (f.guard == Guard::sliding && f.sign.order > 0 && contact.sticks_rigidly())
        found.known[c].sliding.zeros = 1;
      if (slips && found.known[c].sliding.zeros > 0) turning.push_back(c);
      restart_path_at_stop(f, solver_state);
      ContactState& state = solver_state.states[c];
      state = contact::next_state(contact, state, f.guard, solver_state.jets[c]);
      if (const auto* landing = touched(c))  // tried in stick first; the friction limit decides about slip
        state = {contact::state_at_rest(contact), solver_state.jets[c].motion[0].ut + landing->ut};
      continue;
    }
    jointly[blocks_.of[c]] = true;
    // The contact opened, but g' is zero and g becomes negative; or the gap has closed with g' = 0.
    if (f.guard == Guard::closing && f.sign.order > 1 &&
        (found.known[c].touches || solver_state.instant.has_triggered(c, Guard::closing)))
      found.stays[c] = true;
    // The contact was decided as sticking at its static limit, and now exceeds this limit.
    if (slips && found.decided[c])
      (held_by_others(c, solver_state) ? found.stays_at_limit : found.kinetic)[c] = true;
    if (f.guard == Guard::sliding && found.decided[c] &&
        starts_at_zero(f.form, solver_state.jets[c], solver_state.instant))
      found.rests[c] = true;
  }
  stop(turning, solver_state);
  if (solver_state.instant.start && solver_state.decision.rounds == 1)
    for (std::size_t c = 0; c < blocks_.of.size(); ++c)
      if (model_.contacts[c].takes_impulses()) jointly[blocks_.of[c]] = true;
  return selected(blocks_.all, jointly);
}

/// Sets the slip rates of reversing sliders to zero. Since the event is located only within a tolerance, the slip rate at the
/// located time is not exactly zero, and a sticking slider would keep this rate.
void ContactStateSolver::stop(const std::vector<std::size_t>& turning, SolverState& solver_state) const {
  if (turning.empty()) return;
  const motion::StateSystemPtr system = systems_.system_of(solver_state.states);
  if (!system) return;
  const ForceLayout layout = model_.layout.part(turning);
  std::vector<FixedVelocity> fixed;
  for (std::size_t i = 0; i < turning.size(); ++i)
    fixed.push_back({tangent_place(layout, i), &model_.contacts[turning[i]].tangent,
                     solver_state.after.surface(turning[i], solver_state.instant.t, 1)});
  if (has_velocities(fixed, solver_state.instant.v)) return;
  const Eigen::VectorXd impulses =
      impose_velocities(delassus(model_, *system, turning), fixed, solver_state.instant.v);
  solver_state.impact_result.capture(with_reactions(model_, *system, turning, impulses));
}

/// Records the crossings of gaps that closed, up to rounding, at the same time as the gap that triggered the instant.
void ContactStateSolver::record_closed_gaps(SolverState& solver_state) const {
  Decision& d = solver_state.decision;
  if (d.rounds > 1) return;
  for (std::size_t c = 0; c < d.impulses.size(); ++c)
    if (d.impulses[c].hit)
      d.crossings.try_emplace(c,
                              crossing(contact::guards(model_.contacts[c], solver_state.instant.states[c])[0],
                                       solver_state.jets[c]));
}

/// Proposes the next states from the guards that fail in the states tried last.
Refusal ContactStateSolver::propose_states(SolverState& solver_state) {
  Decision& d = solver_state.decision;
  const std::vector<Block> jointly = decide_separate_contacts(solver_state);
  solver_state.impact_result.hit = false;
  if (!jointly.empty()) {
    Refusal why =
        rigid_solver_.decide(solver_state.instant, solver_state.after, solver_state.jets, solver_state.failed,
                             jointly, solver_state.impact_result, d, solver_state.states);
    record_closed_gaps(solver_state);
    if (why) {
      if (!solver_state.failed.empty())
        why.reason += " (after these guards failed: " + names_of(model_, solver_state.failed) + ")";
      return why;
    }
  }
  if (solver_state.impact_result.hit)
    solver_state.tried_states.clear();  // velocities have changed, so earlier states may be tried again
  const bool again = std::find(solver_state.tried_states.begin(), solver_state.tried_states.end(),
                               solver_state.states) != solver_state.tried_states.end();
  if (again && !(solver_state.instant.start && d.rounds == 1))
    if (Refusal why = cycle_fallback_.next_step(solver_state)) return why;
  solver_state.tried_states.push_back(solver_state.states);
  return {};
}

/// Proposes the next states and computes the motion in these states. A slider that stops together with sticking contacts need
/// not stick: if the constraint rows are linearly dependent, the slider and these contacts are decided together.
Refusal ContactStateSolver::try_next_states(SolverState& solver_state) {
  const contact::ContactStates last = solver_state.states;
  if (Refusal why = propose_states(solver_state)) return why;
  if (evaluate(solver_state.after, solver_state.states, solver_state)) return {};
  if (!solver_state.impact_result.hit && !std::exchange(solver_state.impact_result.sliders, true)) {
    solver_state.tried_states.pop_back();
    solver_state.states = last;
    // The motion is computed again, because a joint decision of several sliders needs all its derivatives.
    if (!evaluate(solver_state.after, solver_state.states, solver_state))
      return unsolvable_refusal(model_, solver_state.states);
    if (Refusal why = propose_states(solver_state)) return why;
    if (evaluate(solver_state.after, solver_state.states, solver_state)) return {};
  }
  Refusal why = dependent_rows(contacts_of(solver_state.failed));
  why.reason +=
      fmt::format(" (after these guards failed: {}); {} makes the forces unique",
                  names_of(model_, solver_state.failed), springs_for_uniqueness(model_, why.contacts));
  return why;
}

Refusal ContactStateSolver::iterate(const motion::Forcing& before, SolverState& solver_state) {
  if (Refusal why = begin(before, solver_state)) return why;
  solver_state.tried_states.push_back(solver_state.states);
  check_guards(solver_state, true);
  add_released(solver_state);
  if (solver_state.failed.empty() && !solver_state.instant.triggered.empty() && !solver_state.instant.jump) {
    solver_state
        .increase_noise();  // the engine located a zero of a guard, so a positive value may be rounding
    check_guards(solver_state, true);
  }
  Decision& d = solver_state.decision;
  while (!solver_state.failed.empty() || (solver_state.instant.start && d.rounds == 0)) {
    if (++d.rounds > max_rounds_)
      return {Refusal::Kind::endless,
              fmt::format("state changes at one instant do not end within {} rounds; guards that fail: {}",
                          max_rounds_, names_of(model_, solver_state.failed)),
              contacts_of(solver_state.failed)};
    if (Refusal why = try_next_states(solver_state)) return why;
    check_guards(solver_state, false);
  }
  return {};
}

/// True if the contact sticks at its friction limit from this instant on, and all known derivatives of the guard are zero, so
/// that the time of slip is unknown. noise: rounding error of the distance from the limit; force.
bool ContactStateSolver::sticks_at_limit(const SolverState& solver_state, std::size_t c,
                                         const GuardStart& guard, double noise) {
  const bool limit = contact::is_friction_limit(guard.kind);
  const bool asked = solver_state.instant.start || solver_state.instant.jump ||
                     solver_state.decision.visited[c] || solver_state.impact_result.decided[c];
  return limit && asked && guard.at_zero && guard.leading_order < 0 &&
         std::abs(solver_state.jets[c].motion[0].T) > noise;
}

/// True if the contact stops exactly at its static limit (up to rounding), and kinetic friction is lower. Above the limit the
/// contact would slip at once, by much more than rounding. Not applied at the start of a run, where the friction force is at
/// most at the limit. noise: as for sticks_at_limit().
bool ContactStateSolver::stops_at_static_limit(const SolverState& solver_state, std::size_t c,
                                               const GuardStart& guard, double noise) const {
  const bool asked = solver_state.decision.visited[c] || solver_state.impact_result.decided[c];
  return model_.contacts[c].friction.has_static_drop() && contact::is_friction_limit(guard.kind) && asked &&
         !solver_state.instant.start && guard.at_zero && guard.leading_order > 0 &&
         std::abs(solver_state.jets[c].motion[0].T) > noise;
}

/// True if all guards of contact c are positive by more than their rounding errors.
bool ContactStateSolver::has_clear_guards(const SolverState& solver_state, std::size_t c) {
  return solver_state.open && !std::binary_search(solver_state.open->begin(), solver_state.open->end(), c);
}

/// For a guard that is not clearly positive: determines whether the guard starts at zero, and the order of its first nonzero
/// derivative.
void ContactStateSolver::check_guard_start(SolverState& solver_state, std::size_t c, const GuardForm& guard,
                                           GuardStart& start) const {
  Decision& d = solver_state.decision;
  const MotionJet& jet = solver_state.jets[c];
  const Known known = solver_state.impact_result.known[c].of(guard.kind);
  const MotionJet* base = solver_state.motion_up_to_instant.empty()
                              ? nullptr
                              : resting_reference(model_.contacts[c], c, solver_state.states[c], guard,
                                                  solver_state.motion_up_to_instant[c], solver_state.instant);
  const Sign sign = sign_of_guard(guard, jet, solver_state.instant, known, base);
  start.at_zero =
      known.zeros > 0 || (base ? sign.order > 0 : starts_at_zero(guard, jet, solver_state.instant));
  start.leading_order = sign.order < static_cast<int>(jet.motion.size()) ? sign.order : -1;
  if (start.at_zero && start.leading_order < 0)
    for (std::size_t k = 0; k < start.derivative_noise.size(); ++k)
      start.derivative_noise[k] =
          solver_state.instant.noise_factor * guard.rounding(jet.motion.data(), jet.noise.data(), k + 2);
  // Near its zero, F^2 - T^2 = 2 |T| (F - |T|); F - |T| is a force, as the value of a linear guard of the friction limit is.
  const double per_force = guard.is_linear() ? 1.0 : 2.0 * std::abs(jet.motion[0].T);
  const double noise = start.noise / per_force;
  const bool rests = sticks_at_limit(solver_state, c, start, noise);
  d.undecided = d.undecided || rests;
  const double value = guard.value(jet.motion[0]);
  if (rests || (known.zeros == 0 && stops_at_static_limit(solver_state, c, start, noise)))
    d.at_limit.push_back({c, value / per_force, noise});
  // The decision treated this value as zero, so the engine must treat it as rounding, too.
  if (start.at_zero && (start.leading_order < 0 || base != nullptr))
    start.noise = std::max(start.noise, std::abs(value));
}

/// Sets the members of the decision that the engine and the event log use.
void ContactStateSolver::finish(SolverState& solver_state) {
  Decision& d = solver_state.decision;
  d.consistent = true;
  solver_state.impact_result.capture(solver_state.held);
  d.capture_impulses = solver_state.impact_result.capture_impulses;
  d.departures = solver_state.impact_result.departures;
  d.unresolved = solver_state.impact_result.unresolved;
  d.slides_after = slides(solver_state.after, d);
  d.after.reserve(solver_state.states.size());
  d.guards.assign(d.layout.guard_count(), {});
  for (std::size_t c = 0; c < solver_state.states.size(); ++c) {
    const MotionJet& jet = solver_state.jets[c];
    const ContactMotion& now = jet.motion[0];
    d.after.push_back(now);
    d.jumped[c] = std::abs(now.N - d.before[c].N) > solver_state.noise_before[c].N + jet.noise[0].N ||
                  std::abs(now.T - d.before[c].T) > solver_state.noise_before[c].T + jet.noise[0].T;
    const bool clear = has_clear_guards(solver_state, c);
    const GuardsOfState& guards = guards_.of(c, solver_state.states[c]);
    for (std::size_t i = 0; i < d.layout.guards(c); ++i) {
      const GuardForm& guard = guards[i];
      GuardStart& start = d.guards[d.layout.guard(c, i)];
      if (guard.kind == Guard::none || guard_is_kept_at_zero(c, guard.kind, solver_state)) continue;
      start.kind = guard.kind;
      start.noise = solver_state.instant.noise_factor *
                    (guard.is_linear() ? QuickForm(guard.form).magnitude(jet.noise[0])
                                       : guard.rounding(jet.motion.data(), jet.noise.data(), 0));
      if (!clear) check_guard_start(solver_state, c, guard, start);
    }
  }
  d.forms = guards_.all();
  record_released(solver_state, d);
}

/// Records contacts on massless parts that the enumeration of states has opened at their friction limit, so that their forces
/// drop to zero. CycleFallback::release() records the contacts that it opens itself.
void ContactStateSolver::record_released(const SolverState& solver_state, Decision& d) const {
  const Instant& now = solver_state.instant;
  if (now.jump || now.start || !d.released.empty()) return;
  for (const TriggeredGuard& f : now.triggered) {
    const bool limit = contact::is_friction_limit(f.guard);
    if (limit && !now.states[f.contact].is_open() && d.states[f.contact].is_open() && d.jumped[f.contact] &&
        acts_on_massless(model_, model_.contacts[f.contact]))
      d.released.push_back(f.contact);
  }
}

/// Refusal for a slipping contact whose slip rate is zero with all derivatives because sticking contacts constrain it. In stick
/// its constraint row would be linearly dependent on theirs, so its force is not unique and need not be at the friction limit.
Refusal ContactStateSolver::refuse_undetermined_slip(const SolverState& solver_state) const {
  const Decision& d = solver_state.decision;
  for (std::size_t slot = 0; slot < d.guards.size(); ++slot) {
    const GuardStart& guard = d.guards[slot];
    const std::size_t c = d.layout.contact_of_guard(slot);
    const bool rests = guard.kind == Guard::sliding && guard.at_zero && guard.leading_order < 0;
    if (!rests || !model_.contacts[c].sticks_rigidly()) continue;
    contact::ContactStates sticking = d.states;
    sticking[c].state = State::stick;
    if (systems_.system_of(sticking)) continue;
    Refusal why = dependent_rows({c});
    why.reason += fmt::format(" ('{}' stops slipping); {} makes the forces unique", model_.contacts[c].name,
                              springs_for_uniqueness(model_, why.contacts));
    return why;
  }
  return {};
}

ContactStateSolver::Attempt ContactStateSolver::attempt(const Instant& instant, const motion::Forcing& before,
                                                        const motion::Forcing& after) {
  const std::size_t count = model_.contacts.size();
  SolverState solver_state{instant, after, {}, {}, {}, {}, {}, {}, ImpactResult(count), {}};
  solver_state.jets = std::move(scratch_);
  solver_state.decision.layout = model_.layout;
  solver_state.decision.visited.assign(count, false);
  solver_state.decision.jumped.assign(count, false);
  solver_state.decision.refusal = iterate(before, solver_state);
  if (!solver_state.decision.refusal) {
    finish(solver_state);
    solver_state.decision.refusal = refuse_undetermined_slip(solver_state);
    solver_state.decision.consistent = !solver_state.decision.refusal;
  }
  scratch_ = std::move(solver_state.jets);
  return {std::move(solver_state.decision), solver_state.impact_result.flight_taken_as_rest,
          solver_state.impact_result.max_rest_speed};
}

Decision ContactStateSolver::decide(Instant instant, const motion::Forcing& before,
                                    const motion::Forcing& after) {
  Attempt first = attempt(instant, before, after);
  const Refusal::Kind kind = first.decision.refusal.kind;
  if (kind == Refusal::Kind::none) return std::move(first.decision);
  if (first.flight_taken_as_rest) {
    // If no consistent states exist with the contact at rest, its low flights are computed, as far as the resolution of time
    // permits.
    Instant flying = instant;
    flying.keep_low_flights = true;
    if (Attempt a = attempt(flying, before, after); !a.decision.refusal) return std::move(a.decision);
  }
  // A third attempt treats slip rates as zero up to the speed of the flights that were replaced by rest: the omitted impacts
  // would change these slip rates, and slip ends together with the rebounds.
  const bool painleve = kind == Refusal::Kind::ambiguous || kind == Refusal::Kind::paradox;
  if (!painleve || !(first.max_rest_speed > 0.0)) return std::move(first.decision);
  instant.rest_speed = retry_noise_factor * first.max_rest_speed;
  Attempt second = attempt(instant, before, after);
  if (second.decision.refusal) return std::move(first.decision);
  second.decision.undecided = true;
  return std::move(second.decision);
}

Refusal ContactStateSolver::standstill(const Decision& last, std::vector<std::size_t> contacts,
                                       std::string reason) {
  const double condition = StateEnumeration(systems_, jets_).condition(contacts, last.states);
  return {Refusal::Kind::standstill, std::move(reason), std::move(contacts), condition,
          last.tolerated_violation};
}

Decision ContactStateSolver::adopt(const Instant& instant, const contact::ContactStates& states,
                                   const motion::Forcing& forcing) {
  SolverState solver_state{instant, forcing, {}, {}, {}, {}, {}, {}, ImpactResult(states.size()), {}};
  Decision& d = solver_state.decision;
  d.layout = model_.layout;
  d.visited.assign(states.size(), false);
  d.jumped.assign(states.size(), false);
  contact::ContactStates taken = states;
  if (!evaluate(forcing, taken, solver_state)) {
    d.refusal = unsolvable_refusal(model_, states);
    return std::move(d);
  }
  d.consistent = true;
  d.capture_impulses = solver_state.held;
  for (const MotionJet& jet : solver_state.jets) d.after.push_back(jet.motion[0]);
  d.before = d.after;
  d.slides_after = d.slides_before = slides(forcing, d);
  d.guards.assign(d.layout.guard_count(), {});
  for (std::size_t c = 0; c < taken.size(); ++c)
    for (std::size_t i = 0; i < d.layout.guards(c); ++i)
      d.guards[d.layout.guard(c, i)].kind = guards_.of(c, taken[c])[i].kind;
  d.forms = guards_.all();
  return std::move(d);
}

}  // namespace signorini::decide
