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

/// Derivatives of a guard at its zero, from the motion in the states that end there.
Crossing crossing(const GuardForm& guard, const MotionJet& jet) {
  Crossing result{guard, {}, guard.rounding(jet.motion.data(), jet.noise.data(), 0)};
  for (std::size_t k = 1; k < jet.motion.size(); ++k)
    result.derivatives[k - 1] = guard.derivative(jet.motion.data(), k);
  return result;
}

std::vector<std::size_t> every_contact(const Model& model) {
  std::vector<std::size_t> all(model.contacts.size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

/// Refusal for contact states without a system: the rows of rigid contacts are dependent, or the structure is
/// singular.
Refusal no_system(const Model& model, const contact::ContactStates& states) {
  std::vector<std::size_t> held;
  for (std::size_t c = 0; c < states.size(); ++c)
    if (!states[c].is_open() && (model.contacts[c].takes_impulses() || model.contacts[c].sticks_rigidly()))
      held.push_back(c);
  if (!held.empty()) {
    Refusal why = dependent_rows(held);
    for (const std::size_t c : held)
      if (const std::string alone = holds_no_mass(model, model.contacts[c]); !alone.empty()) {
        why.reason += ": " + alone;
        break;
      }
    return why;
  }
  return {Refusal::Kind::singular,
          "the equations of motion are singular: the least stiffnesses and masses are below the rounding of "
          "the greatest, or outside the range of doubles",
          {}};
}

/// Keys of stiffnesses that make the forces unique, for messages. Only sliders may have a
/// tangential_stiffness without a normal one.
std::string springs_for_uniqueness(const Model& model, const std::vector<std::size_t>& contacts) {
  const auto sliders = std::count_if(contacts.begin(), contacts.end(),
                                     [&](std::size_t k) { return model.contacts[k].normal_force_given(); });
  if (sliders == 0) return "law = \"compliant\"";
  return sliders < static_cast<std::ptrdiff_t>(contacts.size())
             ? "law = \"compliant\", for sliders a tangential_stiffness,"
             : "a tangential_stiffness";
}

}  // namespace

ContactStateSolver::ContactStateSolver(motion::StateSystems& systems, int max_rounds, double capture_velocity,
                                       bool whole_jets)
    : model_(systems.model()),
      systems_(systems),
      jets_(systems),
      all_contacts_(every_contact(model_)),
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

/// Computes the motion in given contact states. False: their rows are dependent.
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
      return decided_by(guards_.of(c, states[c]), c, jet, orders, instant,
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

/// Computes the motion just before, in the old states under the old forcing, and the states that follow from it.
Refusal ContactStateSolver::begin(const motion::Forcing& before, SolverState& solver_state) {
  Instant& instant = solver_state.instant;
  Decision& d = solver_state.decision;
  if (!evaluate(before, instant.states, solver_state)) return no_system(model_, instant.states);
  d.before.reserve(solver_state.jets.size());
  solver_state.noise_before.reserve(solver_state.jets.size());
  for (const MotionJet& jet : solver_state.jets) {
    d.before.push_back(jet.motion[0]);
    solver_state.noise_before.push_back(jet.noise[0]);
  }
  if (!instant.resting_limits.empty()) solver_state.so_far = solver_state.jets;
  d.slides_before = slides(before, d);
  // A rigidly sticking contact moves with its surface, and a rigid contact that touches has no gap: integration drift
  // must not influence the decision.
  if (instant.start) solver_state.initial_u = instant.u;
  instant.u = d.u;
  instant.v = d.v;
  solver_state.impact_result.capture(std::exchange(solver_state.held, {}));
  solver_state.states = instant.states;
  if (!instant.jump) return {};
  apply_forcing_jump(model_, instant, before, solver_state.after, d.before, solver_state.states);
  do {  // ends: each round one more contact sticks
    if (!evaluate(solver_state.after, solver_state.states, solver_state))
      return no_system(model_, solver_state.states);
  } while (resolve_slip_reversal(model_, d.before, solver_state.jets, solver_state.states));
  return {};
}

bool ContactStateSolver::held_by_others(std::size_t c, const SolverState& solver_state) const {
  return systems_.may_share(c) &&
         systems_.held_by_others(c, solver_state.states, solver_state.after, solver_state.instant.t);
}

/// True if others keep the slip rate or the gap of this guard at zero: the guard is then absent.
bool ContactStateSolver::holds_foot(std::size_t c, Guard guard, const SolverState& solver_state) const {
  if (guard == Guard::sliding) return held_by_others(c, solver_state);
  return guard == Guard::closing && solver_state.states[c].is_open() &&
         is_held_at_zero_gap(systems_, c, solver_state.states, solver_state.decision.u);
}

/// Feet at rest whose forces of least norm leave a face of their cones are decided anew.
void ContactStateSolver::add_released(SolverState& solver_state) const {
  const std::vector<std::size_t> failed = contacts_of(solver_state.failed);
  for (const TriggeredGuard& f : solver_state.instant.triggered)
    if (std::find(failed.begin(), failed.end(), f.contact) == failed.end() &&
        holds_foot(f.contact, f.guard, solver_state))
      solver_state.failed.push_back({f.contact, f.guard, {}, {-1, 1, 1.0}});
}

/// Finds the guards that fail in the evaluated states, and notifies the listener. before: these are the
/// states of the motion up to the instant.
void ContactStateSolver::check_guards(SolverState& solver_state, bool before) {
  solver_state.failed =
      find_failed_guards(model_, solver_state.jets, solver_state.states, solver_state.instant, before,
                         solver_state.impact_result.known, solver_state.so_far,
                         solver_state.open ? *solver_state.open : all_contacts_);
  std::erase_if(solver_state.failed, [&](const FailedGuard& f) {
    if (holds_foot(f.contact, f.guard, solver_state)) return true;
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

/// Starts the path of massless parts anew where contact f stops on it, so that the contact stays there. This
/// is done once per contact, because the path is a different one afterwards.
void ContactStateSolver::stop_there(const FailedGuard& f, SolverState& solver_state) const {
  std::vector<std::size_t>& before = solver_state.slid_contacts;
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

std::vector<Block> selected(const std::vector<Block>& blocks, const std::vector<bool>& mask) {
  std::vector<Block> result;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    if (mask[b]) result.push_back(blocks[b]);
  return result;
}

}  // namespace

/// Sets the next states of contacts that are decided separately. Returns the blocks whose contacts must be
/// decided together.
std::vector<Block> ContactStateSolver::react(SolverState& solver_state) const {
  ImpactResult& found = solver_state.impact_result;
  std::vector<bool> jointly(blocks_.all.size(), false);
  std::vector<std::size_t> turning;
  const MasslessPath way{solver_state.jump_origin(), solver_state.decision.u};
  solver_state.touched = first_touch(model_, way, solver_state.failed);
  const auto touched = [&touch = solver_state.touched](std::size_t c) {
    return touch && touch->contact == c;
  };
  if (solver_state.touched && model_.contacts[solver_state.touched->contact].normal_damping > 0.0)
    solver_state.instant.u = way.from + solver_state.touched->fraction * (way.to - way.from);
  // Failures are deferred only until states repeat; then all contacts are decided.
  if (solver_state.decision.rounds >= 2 && !solver_state.noise_increased) {
    defer_slip_failures(model_, solver_state.failed);
    if (!found.sliders)
      defer_pushed_failures(model_, solver_state.decision.visited, blocks_.of, solver_state.failed);
  }
  for (const FailedGuard& f : solver_state.failed) {
    const std::size_t c = f.contact;
    const Contact& contact = model_.contacts[c];
    // A contact that closes on the path has no crossing of its own: the event is another contact's.
    if (!solver_state.decision.visited[c] && !touched(c) &&
        !is_pushed(f, solver_state.instant, solver_state.decision.before[c], solver_state.noise_before[c]))
      solver_state.decision.crossings.insert_or_assign(c, crossing(f.form, solver_state.jets[c]));
    solver_state.decision.visited[c] = true;
    if (found.sliders) jointly[blocks_.of[c]] = true;
    const bool slips = contact::is_friction_limit(f.guard);
    const bool joins = contact.sticks_rigidly() && (found.sliders || systems_.may_share(c));
    if (!contact.takes_impulses() && !joins) {
      // Its slip rate is zero up to rounding, so it is zero in any next state.
      if (f.guard == Guard::sliding && f.sign.order > 0 && contact.sticks_rigidly())
        found.known[c].sliding.zeros = 1;
      if (slips && found.known[c].sliding.zeros > 0) turning.push_back(c);
      stop_there(f, solver_state);
      ContactState& state = solver_state.states[c];
      state = contact::next_state(contact, state, f.guard, solver_state.jets[c]);
      if (touched(c))  // it sticks first; its friction limit decides about slip
        state = {contact::state_at_rest(contact),
                 solver_state.jets[c].motion[0].ut + solver_state.touched->ut};
      continue;
    }
    jointly[blocks_.of[c]] = true;
    // The contact was expected to leave, but g' is zero in the resulting states; or its gap closed with g' zero.
    if (f.guard == Guard::closing && f.sign.order > 1 &&
        (found.known[c].touches || solver_state.instant.has_triggered(c, Guard::closing)))
      found.stays[c] = true;
    // It was at its static limit, which is now exceeded.
    if (slips && found.decided[c])
      (held_by_others(c, solver_state) ? found.bears_limit : found.kinetic)[c] = true;
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

/// Sets the slip rates of sliders that reverse to zero: otherwise the slip rate that is left at the located
/// time would persist.
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

/// Records the crossings of gaps that closed at the same time as others, up to rounding.
void ContactStateSolver::note_hits(SolverState& solver_state) const {
  Decision& d = solver_state.decision;
  if (d.rounds > 1) return;
  for (std::size_t c = 0; c < d.impulses.size(); ++c)
    if (d.impulses[c].hit)
      d.crossings.try_emplace(c,
                              crossing(contact::guards(model_.contacts[c], solver_state.instant.states[c])[0],
                                       solver_state.jets[c]));
}

/// Proposes the next states from the guards that fail in the states tried last.
Refusal ContactStateSolver::propose(SolverState& solver_state) {
  Decision& d = solver_state.decision;
  const std::vector<Block> jointly = react(solver_state);
  solver_state.impact_result.hit = false;
  if (!jointly.empty()) {
    Refusal why =
        rigid_solver_.decide(solver_state.instant, solver_state.after, solver_state.jets, solver_state.failed,
                             jointly, solver_state.impact_result, d, solver_state.states);
    note_hits(solver_state);
    if (why) {
      if (!solver_state.failed.empty())
        why.reason += " (after " + names_of(model_, solver_state.failed) + ")";
      return why;
    }
  }
  if (solver_state.impact_result.hit)
    solver_state.tried_states.clear();  // the velocities are new, so states may recur
  const bool again = std::find(solver_state.tried_states.begin(), solver_state.tried_states.end(),
                               solver_state.states) != solver_state.tried_states.end();
  if (again && !(solver_state.instant.start && d.rounds == 1))
    if (Refusal why = cycle_fallback_.next_step(solver_state)) return why;
  solver_state.tried_states.push_back(solver_state.states);
  return {};
}

/// Proposes the next states and computes their motion. A slider that stops beside sticking contacts need not stick:
/// if the rows are dependent, they are decided together.
Refusal ContactStateSolver::try_next(SolverState& solver_state) {
  const contact::ContactStates last = solver_state.states;
  if (Refusal why = propose(solver_state)) return why;
  if (evaluate(solver_state.after, solver_state.states, solver_state)) return {};
  if (!solver_state.impact_result.hit && !std::exchange(solver_state.impact_result.sliders, true)) {
    solver_state.tried_states.pop_back();
    solver_state.states = last;
    // Several sliders that are decided together need all orders of their motions.
    if (!evaluate(solver_state.after, solver_state.states, solver_state))
      return no_system(model_, solver_state.states);
    if (Refusal why = propose(solver_state)) return why;
    if (evaluate(solver_state.after, solver_state.states, solver_state)) return {};
  }
  Refusal why = dependent_rows(contacts_of(solver_state.failed));
  why.reason += fmt::format(" (after {}); {} makes them unique", names_of(model_, solver_state.failed),
                            springs_for_uniqueness(model_, why.contacts));
  return why;
}

Refusal ContactStateSolver::iterate(const motion::Forcing& before, SolverState& solver_state) {
  if (Refusal why = begin(before, solver_state)) return why;
  solver_state.tried_states.push_back(solver_state.states);
  check_guards(solver_state, true);
  add_released(solver_state);
  if (solver_state.failed.empty() && !solver_state.instant.triggered.empty() && !solver_state.instant.jump) {
    solver_state
        .increase_noise();  // the engine located a zero of a guard: its positive value may be rounding
    check_guards(solver_state, true);
  }
  Decision& d = solver_state.decision;
  while (!solver_state.failed.empty() || (solver_state.instant.start && d.rounds == 0)) {
    if (++d.rounds > max_rounds_)
      return {Refusal::Kind::endless,
              fmt::format("{} rounds of state changes at one instant do not end; guards that fail: {}",
                          max_rounds_, names_of(model_, solver_state.failed)),
              contacts_of(solver_state.failed)};
    if (Refusal why = try_next(solver_state)) return why;
    check_guards(solver_state, false);
  }
  return {};
}

/// True if the contact sticks at its limit from now on, for a time that no derivative determines.
bool ContactStateSolver::rests_at_limit(const SolverState& solver_state, std::size_t c,
                                        const GuardStart& guard) {
  const bool limit = contact::is_friction_limit(guard.kind);
  const bool asked = solver_state.instant.start || solver_state.instant.jump ||
                     solver_state.decision.visited[c] || solver_state.impact_result.decided[c];
  return limit && asked && guard.at_zero && guard.leading_order < 0 &&
         std::abs(solver_state.jets[c].motion[0].T) > guard.noise;
}

/// True if the contact stops at its static limit, up to rounding, and kinetic friction is lower. Beyond the limit it
/// slips immediately, by much more than rounding. At a start the loads lead to the limit, not beyond it.
bool ContactStateSolver::meets_static_limit(const SolverState& solver_state, std::size_t c,
                                            const GuardStart& guard) const {
  const bool asked = solver_state.decision.visited[c] || solver_state.impact_result.decided[c];
  return model_.contacts[c].friction.has_static_drop() && contact::is_friction_limit(guard.kind) && asked &&
         !solver_state.instant.start && guard.at_zero && guard.leading_order > 0 &&
         std::abs(solver_state.jets[c].motion[0].T) > guard.noise;
}

/// True if all guards of contact c are clearly positive in value.
bool ContactStateSolver::clearly_holds(const SolverState& solver_state, std::size_t c) {
  return solver_state.open && !std::binary_search(solver_state.open->begin(), solver_state.open->end(), c);
}

/// For a guard that is not clearly positive: determines whether it starts at zero, and the order of its first nonzero
/// derivative.
void ContactStateSolver::check_guard_start(SolverState& solver_state, std::size_t c, const GuardForm& guard,
                                           GuardStart& start) const {
  Decision& d = solver_state.decision;
  const MotionJet& jet = solver_state.jets[c];
  const Known known = solver_state.impact_result.known[c].of(guard.kind);
  const MotionJet* base = solver_state.so_far.empty()
                              ? nullptr
                              : resting_reference(model_.contacts[c], c, solver_state.states[c], guard,
                                                  solver_state.so_far[c], solver_state.instant);
  const Sign sign = sign_of_guard(guard, jet, solver_state.instant, known, base);
  start.at_zero =
      known.zeros > 0 || (base ? sign.order > 0 : starts_at_zero(guard, jet, solver_state.instant));
  start.leading_order = sign.order < static_cast<int>(jet.motion.size()) ? sign.order : -1;
  if (start.at_zero && start.leading_order < 0)
    for (std::size_t k = 0; k < start.derivative_noise.size(); ++k)
      start.derivative_noise[k] =
          solver_state.instant.noise_factor * guard.rounding(jet.motion.data(), jet.noise.data(), k + 2);
  const bool rests = rests_at_limit(solver_state, c, start);
  d.undecided = d.undecided || rests;
  const double value = guard.value(jet.motion[0]);
  if (rests || (known.zeros == 0 && meets_static_limit(solver_state, c, start)))
    d.at_limit.push_back({c, value, start.noise});
  // A value that the decision took as zero is rounding for the engine, too.
  if (start.at_zero && (start.leading_order < 0 || base != nullptr))
    start.noise = std::max(start.noise, std::abs(value));
}

/// Fills in the data about the new states that engine and log need.
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
    const bool clear = clearly_holds(solver_state, c);
    const GuardsOfState& guards = guards_.of(c, solver_state.states[c]);
    for (std::size_t i = 0; i < d.layout.guards(c); ++i) {
      const GuardForm& guard = guards[i];
      GuardStart& start = d.guards[d.layout.guard(c, i)];
      // Other contacts may hold its slip rate at zero, except for rounding: the guard is then absent.
      if (guard.kind == Guard::none || holds_foot(c, guard.kind, solver_state)) continue;
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

/// Records contacts that enumeration released, in addition to those of CycleFallback::release(): at its
/// friction limit a contact on massless parts opens, and its force drops to zero.
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

/// Refuses a slipping contact whose slip rate is zero with all its derivatives because sticking contacts hold
/// it. Its row depends on theirs, and its force need not stay at the limit.
Refusal ContactStateSolver::held_at_rest(const SolverState& solver_state) const {
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
    why.reason += fmt::format(" ('{}' slips no more); {} makes them unique", model_.contacts[c].name,
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
    solver_state.decision.refusal = held_at_rest(solver_state);
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
    // If no state with the contact at rest is consistent, its flights are computed as long as times resolve
    // them.
    Instant flying = instant;
    flying.keep_low_flights = true;
    if (Attempt a = attempt(flying, before, after); !a.decision.refusal) return std::move(a.decision);
  }
  // Otherwise slip rates as small as the speeds that were taken as rest count as zero. The omitted impacts
  // would change them, and the slip ends with the chatter.
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
    d.refusal = no_system(model_, states);
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
