#include "run/loop.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/rounding.hpp"
#include "decide/driven_states.hpp"
#include "engine/tolerance.hpp"
#include "model/internal_units.hpp"
#include "motion/point.hpp"

namespace signorini::run {
namespace {

// Shorter intervals between breakpoints are skipped, because engines compute 1 / h^2, which must not overflow. The value
// suits every unit of time.
constexpr double shortest_stretch = 1e-100;

/// Indices of the entries of u that pictures show inside steps; nullopt: all.
std::optional<std::vector<int>> watched_entries(const Model& model, const Recorder& recorder) {
  if (!model.is_physical()) return std::nullopt;
  return recorder.wants_motion() ? drawn_entries(model) : std::vector<int>{};
}

/// Contacts whose guards were triggered, or whose states the engine has changed.
std::vector<std::size_t> concerned(const decide::Instant& now,
                                   const std::optional<contact::ContactStates>& adopted) {
  std::vector<std::size_t> contacts = decide::contacts_of(now.triggered);
  for (std::size_t k = 0; adopted && k < adopted->size(); ++k)
    if ((*adopted)[k].state != now.states[k].state) contacts.push_back(k);
  return contacts;
}

/// Converts the graze and the near hits of the engine's report to the units of the scene.
void rescale(const Model& model, engine::StepperReport& engine) {
  if (engine.graze) engine.graze->t = model::time_in_scene_units(model, engine.graze->t);
  for (events::NearHit& hit : engine.near_hits) {
    hit.t = model::time_in_scene_units(model, hit.t);
    hit.gap = model::in_scene_units(model, hit.gap, unit::length);
    hit.half_curvature = model::in_scene_units(model, hit.half_curvature, unit::acceleration);
  }
}

}  // namespace

Loop::Loop(Model& model, const RunSpec& spec, const EngineRow& engine, Method method, Recorder& recorder,
           RunHooks hooks, const PartShare& share)
    : model_(model),
      spec_(spec),
      recorder_(recorder),
      hooks_(std::move(hooks)),
      structure_(model),
      systems_(model, structure_),
      decider_(systems_, spec.max_events_at_once, engine::tolerance_of(model, spec).capture_velocity(),
               !hooks_.listeners.none()),
      engine_(
          engine.make({model, structure_, systems_, spec, engine::tolerance_of(model, spec), method.max_order,
                       hooks_.needs, hooks_.listeners.none(), watched_entries(model, recorder)})),
      record_(model, spec, method, structure_, *engine_, recorder, report_, hooks_.faults, share),
      touches_(model.contacts.size()),
      stall_detector_(spec.t_end, spec.max_events_at_once, model::time_in_scene_units(model, 1.0)),
      breakpoints_(model, spec.t_end),
      changes_(model, spec, engine, report_.method),
      state_{motion::Forcing(model, 0.0, motion::Side::after)} {
  hooks_.listeners.add(record_);
  report_.method = std::move(method);
  decider_.trace(hooks_.rounds);
  report_.warnings = model.warnings;
  for (std::string& sentence : fast_load_warnings(model, spec))
    report_.warnings.push_back(std::move(sentence));
}

void Loop::begin() { running_ = start() && steered(); }

void Loop::advance_to(double until) {
  while (is_running() && state_.t < until) running_ = step();
}

bool Loop::stop(std::string reason, Outcome::Kind kind) {
  report_.outcome.kind = kind;
  report_.outcome.reason = std::move(reason);
  return false;
}

bool Loop::refuse(const Refusal& refusal) {
  report_.outcome.refusal = refusal;
  return stop(refusal.reason);
}

/// Returns false, and stops the run, if the law checker has found an unexplained violation (Violation::unexplained).
bool Loop::has_no_unexplained_violation() {
  return record_.law_violated().empty() || stop(record_.law_violated());
}

motion::Point Loop::decided_point(const decide::Decision& decision) const {
  motion::Point point{decision.u, decision.v, decision.jet.forces.col(0), decision.jet.a()};
  engine_->set_energy(point);
  return point;
}

bool Loop::start() {
  State& s = state_;
  s.point.u = model_.u0;  // last point of the run if the contact states at t = 0 cannot be decided
  s.point.v = model_.v0;
  decide::Instant now;
  now.u = model_.u0;
  now.v = model_.v0;
  // A state that another run saved at an event has guards that are zero up to the resolution of its time.
  now.resolution = s.resolution = motion::resolution_at(model_.saved_time, model_.saved_time);
  now.start = true;
  now.resolves_low_flights = engine_->resolves_low_flights;
  now.states = decide::initial_states(model_, s.forcing, 0.0, model_.u0, model_.v0);
  now.triggered = decide::guards_zero_at_start(model_, model_.u0, model_.v0, now.states);
  const contact::ContactStates guessed = now.states;
  s.decision = decider_.decide(std::move(now), s.forcing, s.forcing);
  if (!s.decision.consistent) return refuse(s.decision.refusal);
  motion::Point after = decided_point(s.decision);
  hooks_.listeners.begin({0.0,
                          s.resolution,
                          {},
                          false,
                          guessed,
                          s.decision,
                          s.forcing,
                          s.forcing,
                          model_.v0,
                          false,
                          false,
                          nullptr,
                          &after});
  s.point = std::move(after);
  begun_ = true;
  // If squares of the motion exceed the range of doubles, the energy balance is unknown.
  if (!std::isfinite(record_.energy().balance()))
    return stop("the energy at the start exceeds the range of doubles");
  return has_no_unexplained_violation();
}

/// Makes one step of the engine. If the step ends at an instant, decides the contact states there. Returns false if the run
/// ends.
bool Loop::step() {
  State& s = state_;
  if (!stretch_.open) {
    const double end = breakpoints_.next();
    if (end - s.t < shortest_stretch) {
      s.t = end;
      return instant({}) && steered();
    }
    if (hooks_.faults) hooks_.faults->watch(s.decision.guards);
    engine_->start({end, &s.decision, &s.forcing, stretch_.same_forcing});
    stretch_.releases =
        FootReleases(decide::releases(systems_, s.forcing, s.t, s.decision.states, s.decision.u));
    stretch_.end = end;
    stretch_.open = true;
  }
  engine::Step step = engine_->advance();
  if (step.kind == engine::Step::Kind::failed) return stop(step.reason);
  stretch_.releases.shorten(step, engine_->dense_output(), s.point);
  s.resolution = step.resolution;
  const bool event = step.kind == engine::Step::Kind::event;
  if (event && hooks_.event_shift) step.end += hooks_.event_shift->shift(step);
  if (event && hooks_.faults) step.end += hooks_.faults->late(step, s.decision);
  finish_step(step);
  if (record_.stopped_at()) return stop("interrupted", Outcome::Kind::interrupted);
  if (event) return instant(std::move(step.triggered), std::move(step.engine_states)) && steered();
  if (!recorder_.progress(s.t)) return stop("interrupted", Outcome::Kind::interrupted);
  if (step.end >= stretch_.end) return instant({}) && steered();
  if (!steer()) return false;
  return !changes_.change().any || (instant({}) && steered());
}

/// Passes the completed step to the listeners: its interior first, then its end. If the recorder ends the run at a row inside
/// the step, the step ends there.
void Loop::finish_step(engine::Step& step) {
  engine::DenseOutput& motion = engine_->dense_output();
  engine::StepFacts facts = motion.facts();
  // A step that ends at a release of a foot has no turning points beyond its end.
  const auto inside = std::upper_bound(facts.turning_points.begin(), facts.turning_points.end(), step.end);
  facts.turning_points =
      facts.turning_points.first(static_cast<std::size_t>(inside - facts.turning_points.begin()));
  const RunStep made{step, facts, state_.decision, state_.forcing, motion};
  hooks_.listeners.step(made);
  if (record_.stopped_at()) {
    step.end = *record_.stopped_at();
    step.kind = engine::Step::Kind::accepted;
  }
  state_.t = step.end;
  motion.evaluate(state_.t, state_.point);
  hooks_.listeners.reached(made, current_point());
}

/// Passes the state at t to the steering recorder. Returns false if the run ends.
bool Loop::steer() {
  if (!recorder_.steers()) return true;
  changes_.set_time(state_.t);
  const bool on = recorder_.steer(record_.sample(current_point()), changes_);
  changes_.apply();
  if (changes_.change().any) {
    record_.loads_changed();
    breakpoints_.loads_changed(model_, state_.t);
  }
  return on || stop("stopped by the observer", Outcome::Kind::interrupted);
}

/// Calls the steering recorder after an instant, repeatedly as long as it changes loads: each change is a new instant.
/// Returns false if the run ends.
bool Loop::steered() {
  do {
    if (!steer()) return false;
    if (changes_.change().any && !instant({})) return false;
  } while (changes_.change().any);
  return true;
}

/// Input of a decision: the motion and the contact states just before the instant.
decide::Instant Loop::instant_now(std::vector<decide::TriggeredGuard> fired) const {
  decide::Instant now;
  now.resolution = state_.resolution;
  now.resolves_low_flights = engine_->resolves_low_flights;
  now.u = state_.point.u;
  now.v = state_.point.v;
  now.states = state_.decision.states;
  now.triggered = std::move(fired);
  now.resting_limits = decide::find_resting_limits(state_.decision);
  now.last_touch = touches_.times();
  return now;
}

/// Decides the contact states at t, applies them and notifies listeners. adopted: states that the engine found, which are
/// not decided again. Returns false if the run ends.
bool Loop::instant(std::vector<decide::TriggeredGuard> fired, std::optional<contact::ContactStates> adopted) {
  State& s = state_;
  // Accelerations just before the instant follow from the forcing before it. At a second instant at the same time, the
  // engine has made no step: s.point is then the point of the last decision.
  if (std::exchange(stretch_.open, false) && record_.needs_accelerations())
    engine_->dense_output().accelerate(s.t, s.point);
  decide::Instant now = instant_now(std::move(fired));
  hooks_.listeners.before(current_point());
  // States that the engine found are applied first; a breakpoint at the same time is a separate, later instant.
  LoadChanges::Change change;
  if (!adopted) {
    const BreakpointQueue::Passed passed = breakpoints_.pass(s.t, s.resolution);
    change = {changes_.change().any || passed.any, changes_.change().jump || passed.jump};
  }
  now.jump = change.any;
  now.t = s.t;
  if (!recorder_.progress(s.t)) return stop("interrupted", Outcome::Kind::interrupted);
  auto stands = stall_detector_.count(s.t, s.resolution, concerned(now, adopted));
  if (stands) *stands += "; last events: " + decide::names_of(model_, now.triggered);
  std::optional<motion::Forcing> before;
  stretch_.same_forcing = !change.any;
  if (change.any) before = std::exchange(s.forcing, motion::Forcing(model_, s.t, motion::Side::after));
  const contact::ContactStates old_states = s.decision.states;
  const std::vector<decide::TriggeredGuard> triggered = now.triggered;
  const motion::Forcing& forcing_before = before ? *before : s.forcing;
  decide::Instant again;
  if (hooks_.faults) again = now;
  decide::Decision next = adopted ? decider_.adopt(now, *adopted, s.forcing)
                                  : decider_.decide(std::move(now), forcing_before, s.forcing);
  if (hooks_.faults && next.consistent) hooks_.faults->inject(decider_, std::move(again), s.forcing, next);
  if (!next.consistent || stands) {
    record_.refused(current_point());
    return refuse(!next.consistent
                      ? next.refusal
                      : decider_.standstill(next, stall_detector_.contacts(), std::move(*stands)));
  }
  motion::Point after = decided_point(next);
  const RunInstant decided{
      s.t,       s.resolution, triggered,   change.any,          old_states, next,  forcing_before,
      s.forcing, s.point.v,    change.jump, adopted.has_value(), &s.point,   &after};
  hooks_.listeners.instant(decided);
  touches_.instant(s.t, old_states, next);
  s.decision = std::move(next);
  s.point = std::move(after);
  if (!has_no_unexplained_violation()) return false;
  // Asked again: the recorder has received the events of this instant.
  return recorder_.progress(s.t) || stop("interrupted", Outcome::Kind::interrupted);
}

RunEnd Loop::end() {
  report_.outcome.t = state_.t;
  engine::StepperReport engine = engine_->report();
  rescale(model_, engine);
  hooks_.listeners.end(current_point(), engine);
  const auto elastic_magnitude = [&](const Vector& u) {
    return 0.5 * structure_.magnitude(structure_.k, u.data());
  };
  const double rounding =
      rounding::many_operations * std::max(elastic_magnitude(model_.u0), elastic_magnitude(state_.point.u));
  return {std::move(report_), rounding, !record_.law_violated().empty()};
}

}  // namespace signorini::run
