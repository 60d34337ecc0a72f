#include "decide/contact_state_solver.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <limits>
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

/// Derivatives of a guard at its zero, from the motion in the mode that ends there.
Crossing crossing(const GuardForm& guard, const MotionJet& jet) {
  Crossing result{guard, {}, guard.rounding(jet.motion.data(), jet.noise.data(), 0)};
  for (std::size_t k = 1; k < jet.motion.size(); ++k)
    result.derivatives[k - 1] = guard.derivative(jet.motion.data(), k);
  return result;
}

/// True if the guard did not reach zero continuously: it was above its rounding just before, and another contact's new
/// state made it jump below zero.
bool is_pushed(const Failure& f, const Instant& instant, const ContactMotion& before,
               const ContactMotion& noise) {
  return f.sign.order == 0 && !instant.has_triggered(f.contact, f.guard) &&
         f.form.value(before) > unlucky * f.form.rounding(&before, &noise, 0);
}

std::vector<std::size_t> every_contact(const Model& model) {
  std::vector<std::size_t> all(model.contacts.size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

/// Largest number of rigidly sticking contacts in a block: the rows of two may be dependent. A contact that takes
/// impulses is always decided with its block; the result is then the largest number of the type.
std::size_t most_rigid_in_a_block(const Model& model, const ContactBlocks& blocks) {
  std::size_t most = 0;
  for (const Block& block : blocks.all) {
    std::size_t rigid = 0;
    for (const std::size_t c : block) {
      if (model.contacts[c].takes_impulses()) return std::numeric_limits<std::size_t>::max();
      rigid += model.contacts[c].sticks_rigidly() ? 1 : 0;
    }
    most = std::max(most, rigid);
  }
  return most;
}

/// Refusal for a mode without a system: dependent rows of its contacts, or a singular structure.
Refusal no_system(const Model& model, const contact::ContactStates& mode) {
  std::vector<std::size_t> held;
  for (std::size_t c = 0; c < mode.size(); ++c)
    if (!mode[c].is_open() && (model.contacts[c].takes_impulses() || model.contacts[c].sticks_rigidly()))
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
  return {
      Refusal::Kind::singular,
      "the equations of motion are singular: the least stiffnesses and masses are below the rounding of the "
      "greatest, or outside the range of numbers",
      {}};
}

/// Stiffnesses that make the forces unique. Only sliders may have a tangential_stiffness without a normal one.
std::string springs_for_uniqueness(const Model& model, const std::vector<std::size_t>& contacts) {
  const bool sliders = std::any_of(contacts.begin(), contacts.end(),
                                   [&](std::size_t k) { return model.contacts[k].normal_force_given(); });
  const bool others = std::any_of(contacts.begin(), contacts.end(),
                                  [&](std::size_t k) { return !model.contacts[k].normal_force_given(); });
  return sliders && others ? "law = \"compliant\", for sliders a tangential_stiffness,"
         : sliders         ? "a tangential_stiffness"
                           : "law = \"compliant\"";
}

}  // namespace

std::vector<TriggeredGuard> resting(const Decision& decision) {
  std::vector<TriggeredGuard> result;
  for (std::size_t i = 0; i < decision.guards.size(); ++i) {
    const GuardStart& guard = decision.guards[i];
    const bool limit = contact::is_friction_limit(guard.kind);
    if (limit && guard.at_zero && guard.leading < 0)
      result.push_back({contact::contact_of_guard(i), guard.kind});
  }
  return result;
}

ContactStateSolver::ContactStateSolver(motion::StateSystems& systems, int max_rounds, double capture_velocity,
                                       bool whole_jets)
    : model_(systems.model()),
      systems_(systems),
      jets_(systems),
      every_(every_contact(model_)),
      max_rounds_(max_rounds),
      touching_(systems, jets_, capture_velocity),
      guards_(model_),
      blocks_(model_),
      circles_(systems, jets_, blocks_) {
  const std::size_t rigid = most_rigid_in_a_block(model_, blocks_);
  each_alone_ = rigid <= 1;
  if (whole_jets || rigid > 0) return;
  near_.emplace(systems);
  if (!near_->possible()) near_.reset();
}

/// Computes the motion in a mode. False: its rows are dependent.
bool ContactStateSolver::evaluate(const motion::Forcing& forcing, contact::ContactStates& mode,
                                  SolverState& course) {
  systems_.mark_static_limits(mode, forcing, course.instant.t);
  Decision& d = course.decision;
  const Instant& instant = course.instant;
  d.system = systems_.of(mode);
  if (!d.system) return false;
  d.u = instant.u;
  d.v = instant.v;
  course.held = near_ ? Eigen::VectorXd() : motion::hold(model_, *d.system, forcing, instant.t, d.u, d.v);
  motion::JetMaker::Enough enough;
  if (each_alone_ && !course.found.sliders)
    enough = [&](std::size_t c, const MotionJet& jet, std::size_t orders) {
      return decided_by(guards_.of(c, mode[c]), c, jet, orders, instant, course.found.known[c], unlucky);
    };
  std::optional<motion::LocalDerivatives::Made> near;
  if (near_) {
    const bool same = course.open && course.forcing == &forcing && course.blur == instant.blur &&
                      d.u == d.jet.u.col(0) && d.v == d.jet.u.col(1);
    near = near_->make(
        d.system, forcing, instant.t, d.u, d.v, course.jets, enough,
        same ? std::optional<motion::LocalDerivatives::Beside>({d.jet, *course.open}) : std::nullopt);
    course.forcing = &forcing;
    course.blur = instant.blur;
  }
  course.open.reset();
  if (near) {
    d.jet = std::move(near->jet);
    course.open = std::move(near->open);
  } else {
    d.jet = jets_.make(d.system, forcing, instant.t, d.u, d.v, course.jets, enough);
  }
  d.u = d.jet.u.col(0);
  d.v = d.jet.u.col(1);
  d.mode = mode;
  return !forces_are_noise(model_, course.jets) || forces_are_unique(systems_, mode);
}

std::vector<motion::BodySlide> ContactStateSolver::slides(const motion::Forcing& forcing,
                                                          const Decision& decision) const {
  std::vector<motion::BodySlide> result;
  result.reserve(model_.contacts.size());
  for (std::size_t k = 0; k < model_.contacts.size(); ++k)
    result.push_back(
        motion::slide_of(model_.contacts[k], k, forcing, decision.jet.t, decision.u, decision.v));
  return result;
}

/// Computes the motion just before, in the old mode under the old forcing, and the states that follow from the forcing.
Refusal ContactStateSolver::begin(const motion::Forcing& before, SolverState& course) {
  Instant& instant = course.instant;
  Decision& d = course.decision;
  if (!evaluate(before, instant.mode, course)) return no_system(model_, instant.mode);
  d.before.reserve(course.jets.size());
  course.noise_before.reserve(course.jets.size());
  for (const MotionJet& jet : course.jets) {
    d.before.push_back(jet.motion[0]);
    course.noise_before.push_back(jet.noise[0]);
  }
  if (!instant.rested.empty()) course.so_far = course.jets;
  d.slides_before = slides(before, d);
  // A rigidly sticking contact moves with its surface, and a rigid contact that touches has no gap: integration drift
  // must not influence the decision.
  if (instant.start) course.given = instant.u;
  instant.u = d.u;
  instant.v = d.v;
  course.found.capture(std::exchange(course.held, {}));
  course.mode = instant.mode;
  if (!instant.jump) return {};
  follow_forcing(model_, instant, before, course.after, d.before, course.mode);
  do {  // ends: each round one more contact sticks
    if (!evaluate(course.after, course.mode, course)) return no_system(model_, course.mode);
  } while (turn_back(model_, d.before, course.jets, course.mode));
  return {};
}

bool ContactStateSolver::held_by_others(std::size_t c, const SolverState& course) const {
  return systems_.may_share(c) && systems_.held_by_others(c, course.mode, course.after, course.instant.t);
}

/// Finds the guards that fail in the evaluated mode. before: it is the mode of the motion up to the instant.
void ContactStateSolver::look(SolverState& course, bool before) {
  course.failed = failures(model_, course.jets, course.mode, course.instant, before, course.found.known,
                           course.so_far, course.open ? *course.open : every_);
  std::erase_if(course.failed, [&](const Failure& f) {
    if (f.guard == Guard::sliding && held_by_others(f.contact, course)) return true;
    return std::find(course.undecided.begin(), course.undecided.end(), blocks_.of[f.contact]) !=
           course.undecided.end();
  });
  if (!listener_) return;
  Round round{course.instant.t, course.decision.rounds, {}, {}, course.found.hit, course.mode, {}};
  for (const TriggeredGuard& f : course.instant.triggered)
    round.triggered.push_back({f.contact, contact::to_string(f.guard)});
  for (const Failure& f : course.failed)
    round.failed.push_back({f.contact, contact::to_string(f.guard), f.sign.order, f.sign.excess});
  for (std::size_t c = 0; c < course.found.known.size(); ++c)
    if (course.found.known[c].touches) round.touching.push_back(c);
  listener_(round);
}

/// Keeps a contact that stops on the way of massless parts where it stopped, not where it started. This is done once
/// per contact, since the way is a different one afterwards.
void ContactStateSolver::stop_there(const Failure& f, SolverState& course) const {
  std::vector<std::size_t>& before = course.slid;
  if (!stops_on_way(model_.contacts[f.contact], f, course.mode[f.contact].state,
                    {course.instant.u, course.decision.u}, course.jets[f.contact].noise[0].ut) ||
      std::find(before.begin(), before.end(), f.contact) != before.end())
    return;
  before.push_back(f.contact);
  course.instant.u = course.decision.u;
  course.seen.clear();
}

/// Gives their next states to contacts that are decided separately. Returns the blocks that must be decided together.
std::vector<Block> ContactStateSolver::react(SolverState& course) const {
  ImpactResult& found = course.found;
  std::vector<bool> jointly(blocks_.all.size(), false);
  std::vector<std::size_t> turning;
  const MasslessWay way{course.comes_from(), course.decision.u};
  course.touched = first_touch(model_, way, course.failed);
  const auto touched = [&](std::size_t c) { return course.touched && course.touched->contact == c; };
  if (course.touched && model_.contacts[course.touched->contact].normal_damping > 0.0)
    course.instant.u = way.from + course.touched->part * (way.to - way.from);
  if (course.decision.rounds >= 2 && !course.blurred) {  // once: if modes repeat, all contacts are decided
    leave_sliding_for_later(model_, course.failed);
    if (!found.sliders) leave_pushed_for_later(model_, course.decision.visited, blocks_.of, course.failed);
  }
  for (const Failure& f : course.failed) {
    const std::size_t c = f.contact;
    const Contact& contact = model_.contacts[c];
    // The time of a touch on the way is that of another contact's event.
    if (!course.decision.visited[c] && !touched(c) &&
        !is_pushed(f, course.instant, course.decision.before[c], course.noise_before[c]))
      course.decision.crossings.insert_or_assign(c, crossing(f.form, course.jets[c]));
    course.decision.visited[c] = true;
    if (found.sliders) jointly[blocks_.of[c]] = true;
    const bool slips = contact::is_friction_limit(f.guard);
    const bool joins = contact.sticks_rigidly() && (found.sliders || systems_.may_share(c));
    if (!contact.takes_impulses() && !joins) {
      // Its slip rate is zero up to rounding, so it is zero in any next state.
      if (f.guard == Guard::sliding && f.sign.order > 0 && contact.sticks_rigidly())
        found.known[c].sliding.zeros = 1;
      if (slips && found.known[c].sliding.zeros > 0) turning.push_back(c);
      stop_there(f, course);
      course.mode[c] = contact::next_state(contact, course.mode[c], f.guard, course.jets[c]);
      if (touched(c))  // elastic first; its limit decides about slip
        course.mode[c] = {contact::state_at_rest(contact), course.jets[c].motion[0].ut + course.touched->ut};
      continue;
    }
    jointly[blocks_.of[c]] = true;
    // The contact was expected to leave, but g' is zero in the resulting mode; or its gap closed with g' zero.
    if (f.guard == Guard::closing && f.sign.order > 1 &&
        (found.known[c].touches || course.instant.has_triggered(c, Guard::closing)))
      found.stays[c] = true;
    // It was at its static limit, which is now exceeded.
    if (slips && found.decided[c]) (held_by_others(c, course) ? found.bears_limit : found.kinetic)[c] = true;
    if (f.guard == Guard::sliding && found.decided[c] &&
        starts_at_zero(f.form, course.jets[c], course.instant))
      found.rests[c] = true;
  }
  stop(turning, course);
  if (course.instant.start && course.decision.rounds == 1)
    for (std::size_t c = 0; c < blocks_.of.size(); ++c)
      if (model_.contacts[c].takes_impulses()) jointly[blocks_.of[c]] = true;
  std::vector<Block> result;
  for (std::size_t b = 0; b < blocks_.all.size(); ++b)
    if (jointly[b]) result.push_back(blocks_.all[b]);
  return result;
}

/// Stops sliders that reverse: the slip rate left by the location of the event would otherwise persist.
void ContactStateSolver::stop(const std::vector<std::size_t>& turning, SolverState& course) const {
  if (turning.empty()) return;
  const motion::StateSystemPtr system = systems_.of(course.mode);
  if (!system) return;
  std::vector<Fixed> fixed;
  for (std::size_t i = 0; i < turning.size(); ++i)
    fixed.push_back({tangent_place(i), &model_.contacts[turning[i]].tangent,
                     course.after.surface(turning[i], course.instant.t, 1)});
  if (settled(fixed, course.instant.v)) return;
  const Eigen::VectorXd impulses = settle(delassus(model_, *system, turning), fixed, course.instant.v);
  course.found.capture(with_reactions(model_, *system, turning, impulses));
}

/// Records the crossings of gaps that closed together with others, up to rounding.
void ContactStateSolver::note_hits(SolverState& course) const {
  Decision& d = course.decision;
  if (d.rounds > 1) return;
  for (std::size_t c = 0; c < d.impulses.size(); ++c)
    if (d.impulses[c].hit)
      d.crossings.try_emplace(
          c, crossing(contact::guards(model_.contacts[c], course.instant.mode[c])[0], course.jets[c]));
}

/// Proposes the next mode from the guards that failed in the last one.
Refusal ContactStateSolver::propose(SolverState& course) {
  Decision& d = course.decision;
  const std::vector<Block> jointly = react(course);
  course.found.hit = false;
  if (!jointly.empty()) {
    Refusal why = touching_.decide(course.instant, course.after, course.jets, course.failed, jointly,
                                   course.found, d, course.mode);
    note_hits(course);
    if (why) {
      if (!course.failed.empty()) why.reason += " (after " + names_of(model_, course.failed) + ")";
      return why;
    }
  }
  if (course.found.hit) course.seen.clear();  // the velocities are new, so modes may recur
  const bool again = std::find(course.seen.begin(), course.seen.end(), course.mode) != course.seen.end();
  if (again && !(course.instant.start && d.rounds == 1))
    if (Refusal why = circles_.leave(course)) return why;
  course.seen.push_back(course.mode);
  return {};
}

/// Proposes the next mode and computes its motion. A slider that stops beside sticking contacts need not stick: if the
/// rows are dependent, they are decided together.
Refusal ContactStateSolver::try_next(SolverState& course) {
  const contact::ContactStates last = course.mode;
  if (Refusal why = propose(course)) return why;
  if (evaluate(course.after, course.mode, course)) return {};
  if (!course.found.hit && !std::exchange(course.found.sliders, true)) {
    course.seen.pop_back();
    course.mode = last;
    // The joint decision of several sliders needs all orders of their motions.
    if (!evaluate(course.after, course.mode, course)) return no_system(model_, course.mode);
    if (Refusal why = propose(course)) return why;
    if (evaluate(course.after, course.mode, course)) return {};
  }
  Refusal why = dependent_rows(contacts_of(course.failed));
  why.reason += fmt::format(" (after {}); {} makes them so", names_of(model_, course.failed),
                            springs_for_uniqueness(model_, why.contacts));
  return why;
}

Refusal ContactStateSolver::go(const motion::Forcing& before, SolverState& course) {
  if (Refusal why = begin(before, course)) return why;
  course.seen.push_back(course.mode);
  look(course, true);
  if (course.failed.empty() && !course.instant.triggered.empty() && !course.instant.jump) {
    course.make_blurred();  // the engine located a zero of a guard: its positive value may be rounding
    look(course, true);
  }
  Decision& d = course.decision;
  while (!course.failed.empty() || (course.instant.start && d.rounds == 0)) {
    if (++d.rounds > max_rounds_)
      return {Refusal::Kind::endless,
              fmt::format("{} rounds of state changes at one instant do not end; guards that fail: {}",
                          max_rounds_, names_of(model_, course.failed)),
              contacts_of(course.failed)};
    if (Refusal why = try_next(course)) return why;
    look(course, false);
  }
  return {};
}

/// True if the contact sticks at its limit from this instant on, for a time that no derivative determines.
bool ContactStateSolver::rests_at_limit(const SolverState& course, std::size_t c, const GuardStart& guard) {
  const bool limit = contact::is_friction_limit(guard.kind);
  const bool asked =
      course.instant.start || course.instant.jump || course.decision.visited[c] || course.found.decided[c];
  return limit && asked && guard.at_zero && guard.leading < 0 &&
         std::abs(course.jets[c].motion[0].T) > guard.noise;
}

/// True if the contact stops at its static limit, up to rounding, and kinetic friction is lower. Beyond the limit it
/// slips immediately, by much more than rounding. At a start the loads lead to the limit, not beyond it.
bool ContactStateSolver::meets_static_limit(const SolverState& course, std::size_t c,
                                            const GuardStart& guard) const {
  const bool asked = course.decision.visited[c] || course.found.decided[c];
  return model_.contacts[c].friction.drops() && contact::is_friction_limit(guard.kind) && asked &&
         !course.instant.start && guard.at_zero && guard.leading > 0 &&
         std::abs(course.jets[c].motion[0].T) > guard.noise;
}

/// True if all its guards are positive at order 0.
bool ContactStateSolver::clearly_holds(const SolverState& course, std::size_t c) {
  return course.open && !std::binary_search(course.open->begin(), course.open->end(), c);
}

/// For a guard that is not clearly positive: determines whether it starts at zero, and the order of its first nonzero
/// derivative.
void ContactStateSolver::look_at_start(SolverState& course, std::size_t c, const GuardForm& guard,
                                       GuardStart& start) const {
  Decision& d = course.decision;
  const MotionJet& jet = course.jets[c];
  const Known known = course.found.known[c].of(guard.kind);
  const MotionJet* base = course.so_far.empty() ? nullptr
                                                : rested(model_.contacts[c], c, course.mode[c], guard,
                                                         course.so_far[c], course.instant);
  const Sign sign = sign_of_guard(guard, jet, course.instant, known, base);
  start.at_zero = known.zeros > 0 || (base ? sign.order > 0 : starts_at_zero(guard, jet, course.instant));
  start.leading = sign.order < static_cast<int>(jet.motion.size()) ? sign.order : -1;
  if (start.at_zero && start.leading < 0)
    for (std::size_t k = 0; k < start.loose.size(); ++k)
      start.loose[k] = course.instant.blur * guard.rounding(jet.motion.data(), jet.noise.data(), k + 2);
  const bool rests = rests_at_limit(course, c, start);
  d.undecided = d.undecided || rests;
  const double value = guard.value(jet.motion[0]);
  if (rests || (known.zeros == 0 && meets_static_limit(course, c, start)))
    d.at_limit.push_back({c, value, start.noise});
  // A value that the decision took as zero is rounding for the engine, too.
  if (start.at_zero && (start.leading < 0 || base != nullptr))
    start.noise = std::max(start.noise, std::abs(value));
}

/// Fills in the data about the new mode that engine and log need.
void ContactStateSolver::finish(SolverState& course) {
  Decision& d = course.decision;
  d.consistent = true;
  course.found.capture(course.held);
  d.captures = course.found.captures;
  d.departures = course.found.departures;
  d.unresolved = course.found.unresolved;
  d.slides_after = slides(course.after, d);
  d.after.reserve(course.mode.size());
  d.guards.reserve(contact::guard_count(course.mode.size()));
  for (std::size_t c = 0; c < course.mode.size(); ++c) {
    const MotionJet& jet = course.jets[c];
    const ContactMotion& now = jet.motion[0];
    d.after.push_back(now);
    d.jumped[c] = std::abs(now.N - d.before[c].N) > course.noise_before[c].N + jet.noise[0].N ||
                  std::abs(now.T - d.before[c].T) > course.noise_before[c].T + jet.noise[0].T;
    const bool clear = clearly_holds(course, c);
    for (const GuardForm& guard : guards_.of(c, course.mode[c])) {
      GuardStart& start = d.guards.emplace_back();
      // Other contacts may hold its slip rate at zero, except for rounding: the guard is then absent.
      if (guard.kind == Guard::none || (guard.kind == Guard::sliding && held_by_others(c, course))) continue;
      start.kind = guard.kind;
      start.noise =
          course.instant.blur * (guard.is_linear() ? QuickForm(guard.form).magnitude(jet.noise[0])
                                                   : guard.rounding(jet.motion.data(), jet.noise.data(), 0));
      if (!clear) look_at_start(course, c, guard, start);
    }
  }
  d.forms = guards_.all();
  note_left(course, d);
}

/// Enumeration may give the same result as release(): a contact at its limit of friction opens, and its force drops to
/// zero.
void ContactStateSolver::note_left(const SolverState& course, Decision& d) const {
  const Instant& now = course.instant;
  if (now.jump || now.start || !d.released.empty()) return;
  for (const TriggeredGuard& f : now.triggered) {
    const bool limit = contact::is_friction_limit(f.guard);
    if (limit && !now.mode[f.contact].is_open() && d.mode[f.contact].is_open() && d.jumped[f.contact] &&
        carries_massless(model_, model_.contacts[f.contact]))
      d.released.push_back(f.contact);
  }
}

/// Refuses a slipping contact whose slip rate is zero with all its derivatives if sticking contacts hold it: its own
/// row is then dependent on theirs, and its force need not stay at the limit.
Refusal ContactStateSolver::held_at_rest(const SolverState& course) const {
  const Decision& d = course.decision;
  for (std::size_t slot = 0; slot < d.guards.size(); ++slot) {
    const GuardStart& guard = d.guards[slot];
    const std::size_t c = contact::contact_of_guard(slot);
    const bool rests = guard.kind == Guard::sliding && guard.at_zero && guard.leading < 0;
    if (!rests || !model_.contacts[c].sticks_rigidly()) continue;
    contact::ContactStates sticking = d.mode;
    sticking[c].state = State::stick;
    if (systems_.of(sticking)) continue;
    Refusal why = dependent_rows({c});
    why.reason += fmt::format(" ('{}' slips no more); {} makes them so", model_.contacts[c].name,
                              springs_for_uniqueness(model_, why.contacts));
    return why;
  }
  return {};
}

ContactStateSolver::Attempt ContactStateSolver::attempt(const Instant& instant, const motion::Forcing& before,
                                                        const motion::Forcing& after) {
  const std::size_t count = model_.contacts.size();
  SolverState course{instant, after, {}, {}, {}, {}, {}, {}, ImpactResult(count), {}};
  course.jets = std::move(room_);
  course.decision.visited.assign(count, false);
  course.decision.jumped.assign(count, false);
  course.decision.refusal = go(before, course);
  if (!course.decision.refusal) {
    finish(course);
    course.decision.refusal = held_at_rest(course);
    course.decision.consistent = !course.decision.refusal;
  }
  room_ = std::move(course.jets);
  return {std::move(course.decision), course.found.grounded, course.found.slowest};
}

Decision ContactStateSolver::decide(Instant instant, const motion::Forcing& before,
                                    const motion::Forcing& after) {
  Attempt first = attempt(instant, before, after);
  const Refusal::Kind kind = first.decision.refusal.kind;
  if (kind == Refusal::Kind::none) return std::move(first.decision);
  if (first.grounded) {
    // A flight of a chattering contact is computed until the clock resolves no more, if resting has no consistent
    // state.
    Instant flying = instant;
    flying.low_flights = true;
    if (Attempt a = attempt(flying, before, after); !a.decision.refusal) return std::move(a.decision);
  }
  // Otherwise slip rates as small as the flights taken as rest count as rest: hits that are left out would change them,
  // and the slip ends with the chatter.
  const bool painleve = kind == Refusal::Kind::ambiguous || kind == Refusal::Kind::paradox;
  if (!painleve || !(first.slowest > 0.0)) return std::move(first.decision);
  instant.slow = unlucky * first.slowest;
  Attempt resting = attempt(instant, before, after);
  if (resting.decision.refusal) return std::move(first.decision);
  resting.decision.undecided = true;
  return std::move(resting.decision);
}

Refusal ContactStateSolver::standstill(const Decision& last, std::vector<std::size_t> contacts,
                                       std::string reason) {
  const double condition = Enumeration(systems_, jets_).condition(contacts, last.mode);
  return {Refusal::Kind::standstill, std::move(reason), std::move(contacts), condition, last.forgiven};
}

Decision ContactStateSolver::adopt(const Instant& instant, const contact::ContactStates& mode,
                                   const motion::Forcing& forcing) {
  SolverState course{instant, forcing, {}, {}, {}, {}, {}, {}, ImpactResult(mode.size()), {}};
  Decision& d = course.decision;
  d.visited.assign(mode.size(), false);
  d.jumped.assign(mode.size(), false);
  contact::ContactStates taken = mode;
  if (!evaluate(forcing, taken, course)) {
    d.refusal = no_system(model_, mode);
    return std::move(d);
  }
  d.consistent = true;
  d.captures = course.held;
  for (const MotionJet& jet : course.jets) d.after.push_back(jet.motion[0]);
  d.before = d.after;
  d.slides_after = d.slides_before = slides(forcing, d);
  for (std::size_t c = 0; c < taken.size(); ++c)
    for (const GuardForm& guard : guards_.of(c, taken[c])) d.guards.push_back({guard.kind});
  d.forms = guards_.all();
  return std::move(d);
}

}  // namespace signorini::decide
