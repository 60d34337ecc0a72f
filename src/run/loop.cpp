#include "run/loop.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/rounding.hpp"
#include "decide/driven_states.hpp"
#include "model/said.hpp"
#include "motion/clock.hpp"
#include "run/warnings.hpp"

namespace signorini {
namespace {

// A stretch h in which nothing moves: engines divide by h^2, which must not overflow. In any unit of time.
constexpr double shortest_stretch = 1e-100;
// Warnings about impacts that gain energy, about contacts left at once, and about rest at a limit of friction.
constexpr int most_gains = 5;

}  // namespace

Loop::Loop(Model& model, const RunSpec& spec, const EngineRow& engine, Method method, Recorder& recorder,
           const Company& company, const PartShare& share)
    : model_(model),
      spec_(spec),
      recorder_(recorder),
      observer_(company.observer),
      meddler_(company.meddler),
      structure_(model),
      systems_(model, structure_),
      tolerance_(tolerance_of(model, spec)),
      decider_(systems_, spec.max_events_at_once, tolerance_.capture_velocity(), observer_ != nullptr),
      engine_(engine.make({model, structure_, systems_, spec, tolerance_, method.max_order,
                           observer_ ? observer_->modal() : nullptr, !observer_ || observer_->asks_peaks(),
                           observer_ == nullptr, observer_ ? observer_->step_seed() : 0})),
      truth_(meddler_ ? std::make_unique<Model>(model) : nullptr),
      witness_(corrected(), witnessed_engine(spec, tolerance_, method.flow, engine_->knows_low_flights()),
               recorder),
      auditor_(model, structure_),
      log_(model, recorder, report_, share.whole()),
      samples_(model, spec, auditor_, recorder, share.grid),
      motion_(model, spec.t_end, recorder, share),
      curves_(model, spec.t_end, recorder, share),
      response_(model, spec.t_end, recorder, name_of(spec.engine).accuracy != Accuracy::step),
      touches_(model.contacts.size()),
      large_(model),
      standstill_(spec.t_end, spec.max_events_at_once, said_time(model, 1.0)),
      breakpoints_(breakpoints(model, spec.t_end)),
      forcing_(model, 0.0, Side::after),
      changes_(model, spec, engine, report_.method) {
  report_.method = std::move(method);
  decider_.trace(company.listener);
  report_.warnings = model.warnings;
  for (std::string& sentence : swings_within_steps(model, spec))
    report_.warnings.push_back(std::move(sentence));
}

void Loop::begin() { going_ = start() && steered(); }

void Loop::on(double until) {
  while (goes_on() && t_ < until) going_ = step();
}

const Model& Loop::corrected() {
  if (!truth_) return model_;
  meddler_->correct(*truth_);
  return *truth_;
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

/// What pictures show of the motion inside of steps.
void Loop::watch() {
  if (model_.is_physical()) engine_->watch(curves_.dofs());
}

bool Loop::start() {
  watch();
  point_.u = model_.u0;  // of a run that is refused here it is the last one
  point_.v = model_.v0;
  Instant now;
  now.u = model_.u0;
  now.v = model_.v0;
  now.resolution = resolution_ = resolution_at(0.0, 0.0);
  now.start = true;
  now.knows_low_flights = engine_->knows_low_flights();
  now.mode = first_mode(model_, forcing_, 0.0, model_.u0, model_.v0);
  now.fired = fell_at_start(model_, model_.u0, model_.v0, now.mode);
  const Mode guessed = now.mode;
  decision_ = decider_.decide(std::move(now), forcing_, forcing_);
  if (!decision_.consistent) return refuse(decision_.refusal);
  const std::vector<std::string> cut = cut_shears(model_, decision_);
  report_.warnings.insert(report_.warnings.end(), cut.begin(), cut.end());
  warn_of_decision();
  if (observer_) observer_->begin({0.0, 0.0, {}, false, guessed, decision_, forcing_, forcing_, model_.v0});
  auditor_.begin(decision_, guessed, forcing_, decided_point());
  log_.start({0.0, 0.0, &decision_, &guessed, false}, *engine_);
  zero_since_.decided(0.0, decision_, true);
  const Point given{model_.u0, model_.v0, decision_.jet.forces.col(0)};
  RunWitness::Instant seen{0.0,       resolution_, &given,     &guessed,
                           &forcing_, &forcing_,   &decision_, &log_.latest()};
  seen.start = true;
  witness_.instant(seen);
  take_decision(std::nullopt);
  begun_ = true;
  // Squares of a motion that numbers still hold may be beyond them: then nothing is known of the balance.
  if (!std::isfinite(last_energy_.balance()))
    return stop("the energy at the start leaves the range of numbers");
  return witnessed();
}

/// From a restart to the next discontinuity, at `end`, or to an event before.
void Loop::open_stretch(double end) {
  if (meddler_) meddler_->watch(decision_.guards);
  engine_->start({end, &decision_, &forcing_, same_forcing_});
  stretch_end_ = end;
  under_way_ = true;
}

/// A step of the engine, and the instant at its end if there is one. False: the run ends.
bool Loop::step() {
  if (!under_way_) {
    const bool at_breakpoint = next_breakpoint_ < breakpoints_.size();
    const double end = at_breakpoint ? breakpoints_[next_breakpoint_].time : spec_.t_end;
    if (end - t_ < shortest_stretch) {
      t_ = end;
      return instant({}) && steered();
    }
    open_stretch(end);
  }
  Step step = engine_->advance();
  if (step.kind == Step::Kind::failed) return stop(step.reason);
  resolution_ = step.resolution;
  if (observer_)
    observer_->step({step, engine_->expansion(), decision_, forcing_, engine_->turning_points()});
  if (observer_ && step.kind == Step::Kind::event) step.end += observer_->moves(step);
  if (meddler_ && step.kind == Step::Kind::event) step.end += meddler_->late(step, decision_);
  pass(step);
  if (step.kind == Step::Kind::event)
    return instant(std::move(step.fired), std::move(step.adopted)) && steered();
  auditor_.observe(forcing_, t_, decision_.mode, point_);
  witness_.between(t_, forcing_, decision_.mode, point_, engine_->dependence());
  if (residual_due_) auditor_.equilibrium(t_, engine_->residual());
  residual_due_ = false;
  if (!recorder_.progress(t_)) return stop("interrupted", Outcome::Kind::interrupted);
  if (step.end >= stretch_end_) return instant({}) && steered();
  if (!steer()) return false;
  return !change_.any || (instant({}) && steered());
}

/// Hands the state at t_ to who steers. False: the run ends.
bool Loop::steer() {
  if (!recorder_.steers()) return true;
  changes_.at(t_);
  works_.clear();
  const bool on = recorder_.steer(samples_.sample(t_, works_, forcing_, decision_.mode, point_), changes_);
  change_ = changes_.take();
  if (change_.any) {
    response_.loads_changed();
    breakpoints_ = breakpoints(model_, spec_.t_end);
    next_breakpoint_ =
        static_cast<std::size_t>(std::upper_bound(breakpoints_.begin(), breakpoints_.end(), t_,
                                                  [](double t, const Breakpoint& b) { return t < b.time; }) -
                                 breakpoints_.begin());
  }
  return on || stop("stopped by the observer", Outcome::Kind::interrupted);
}

/// After an instant, as long as loads are changed there: each change is an instant of its own.
bool Loop::steered() {
  do {
    if (!steer()) return false;
    if (change_.any && !instant({})) return false;
  } while (change_.any);
  return true;
}

/// What lies inside a step: its works, whole, so that rows change no digit of what is told at the end; rows,
/// extremes, and times for pictures; then its end.
void Loop::pass(const Step& step) {
  works_.clear();
  engine_->integrate(step.begin, step.end, works_);
  auditor_.add(works_);
  for (double t = samples_.next(); t < step.end; t = samples_.next()) {
    Point point;
    engine_->evaluate(t, point);
    works_.clear();
    engine_->integrate(t, step.end, works_);
    emit(t, point);
    witness_.passes(t, forcing_, point);
  }
  response_.inside(*engine_, step.begin, step.end);
  const auto turns = motion_.wanted() || curves_.wanted() ? std::nullopt : engine_->contact_turns();
  motion_.step(step.begin, step.end, turns ? std::vector<double>{} : engine_->turning_points());
  if (turns) pass_turns(*turns);
  while (const auto moment = motion_.next()) {
    engine_->glimpse(moment->t, point_);
    if (moment->turns && !(meddler_ && meddler_->forgets_peaks_inside()))
      auditor_.observe(forcing_, moment->t, decision_.mode, point_);
    if (moment->turns) witness_.passes(moment->t, forcing_, point_);
    motion_.add(moment->t, auditor_, forcing_, decision_.mode, point_);
    if (curves_.needs(moment->t)) add_curves(moment->t, step.end);
    motion_.adapt(moment->t, curves_.asked());
  }
  t_ = step.end;
  engine_->evaluate(t_, point_);
  large_.see(t_, forcing_, point_);
  if (step.kind != Step::Kind::event && motion_.needs(t_))
    motion_.add(t_, auditor_, forcing_, decision_.mode, point_);
  if (step.kind != Step::Kind::event && curves_.needs(t_)) {
    add_curves(t_, t_);
    motion_.adapt(t_, curves_.asked());
  }
}

/// Nobody draws the motion: each contact is looked at where it turns itself.
void Loop::pass_turns(const std::vector<Stepper::ContactTurn>& turns) {
  for (const auto& [contact, t] : turns) {
    if (!std::isfinite(t)) continue;
    engine_->glimpse(t, contact, point_);
    if (!(meddler_ && meddler_->forgets_peaks_inside()))
      auditor_.observe(contact, forcing_, t, decision_.mode, point_);
    witness_.passes(contact, t, forcing_, point_);
  }
}

/// Decides the states at t_, applies and records them.
bool Loop::instant(std::vector<Fired> fired, std::optional<Mode> adopted) {
  // Under the forcing before. Where no stretch was opened the point is the decision's, and the engine may know none.
  if (std::exchange(under_way_, false) && response_.any()) engine_->accelerate(t_, point_);
  Instant now;
  now.resolution = resolution_;
  now.knows_low_flights = engine_->knows_low_flights();
  now.u = point_.u;
  now.v = point_.v;
  now.mode = decision_.mode;
  motion_.before(t_, auditor_, forcing_, decision_.mode, point_);
  if (curves_.wanted()) add_curves(t_, t_);
  now.fired = std::move(fired);
  now.rested = resting(decision_);
  now.touched = touches_.times();
  // States that an engine found itself come first; a breakpoint at the same time is the next instant.
  const bool load_jumps = !adopted && pass_breakpoints(now);
  now.t = t_;
  if (!recorder_.progress(t_)) return stop("interrupted", Outcome::Kind::interrupted);
  std::vector<std::size_t> changed = concerned(now, adopted);
  auto stands = standstill_.count(t_, resolution_, changed);
  if (stands) *stands += "; last: " + names_of(model_, now.fired);
  std::optional<Forcing> before;
  const bool all = now.jump;
  same_forcing_ = !all;
  if (all) before = std::exchange(forcing_, Forcing(model_, t_, Side::after));
  const Mode old_mode = decision_.mode;
  std::vector<double> unseen = zero_since_.before(t_, now.fired);
  const std::vector<Fired> observed = observer_ ? now.fired : std::vector<Fired>{};
  Instant again;
  if (meddler_) again = now;
  Decision next = adopted ? decider_.adopt(now, *adopted, forcing_)
                          : decider_.decide(std::move(now), before ? *before : forcing_, forcing_);
  if (meddler_ && next.consistent) meddle(std::move(again), next);
  if (!next.consistent || stands) {
    last_energy_ = auditor_.energy(t_, decision_.mode, point_);
    return refuse(!next.consistent ? next.refusal
                                   : decider_.standstill(next, standstill_.contacts(), std::move(*stands)));
  }
  if (observer_)
    observer_->instant({t_, resolution_, observed, all, old_mode, next, before ? *before : forcing_, forcing_,
                        point_.v, load_jumps});
  touches_.instant(t_, old_mode, next);
  if (all || next.mode != old_mode || !next.impulses.empty()) response_.before(t_, point_, auditor_.losses());
  auditor_.instant(t_, next, old_mode, point_, forcing_, load_jumps);
  decision_ = std::move(next);
  warn_of_decision();
  log_.instant({t_, resolution_, &decision_, &old_mode, load_jumps, std::move(unseen)}, *engine_);
  zero_since_.decided(t_, decision_, all);
  witness_.instant({t_, resolution_, &point_, &old_mode, before ? &*before : &forcing_, &forcing_, &decision_,
                    &log_.latest(), false, all, load_jumps, adopted.has_value(), engine_->dependence()});
  for (std::size_t k = 0; k < old_mode.size(); ++k)
    if (decision_.mode[k].state != old_mode[k].state) changed.push_back(k);
  take_decision(all ? std::nullopt : std::optional(std::move(changed)));
  return witnessed();
}

/// False: what was recorded of the motion up to here breaks a law, and nothing explains it.
bool Loop::witnessed() { return witness_.grave().empty() || stop(witness_.grave()); }

/// The motion goes on from what a test has made of a decision.
void Loop::meddle(Instant now, Decision& decided) {
  Decision changed = decided;
  if (!meddler_->change(now.mode, point_.v, changed)) return;
  now.u = changed.u;
  now.v = changed.v;
  const Decision other = decider_.adopt(now, changed.mode, forcing_);
  changed.consistent = other.consistent;
  changed.refusal = other.refusal;
  changed.system = other.system;
  changed.u = other.u;
  changed.v = other.v;
  changed.jet = other.jet;
  changed.after = other.after;
  changed.slides_after = other.slides_after;
  changed.guards = other.guards;
  changed.forms = other.forms;
  changed.captures = other.captures;
  decided = std::move(changed);
}

/// Contacts whose guards fell, or whose states the engine has changed.
std::vector<std::size_t> Loop::concerned(const Instant& now, const std::optional<Mode>& adopted) const {
  std::vector<std::size_t> contacts;
  for (const Fired& f : now.fired) contacts.push_back(f.contact);
  for (std::size_t k = 0; adopted && k < adopted->size(); ++k)
    if ((*adopted)[k].state != now.mode[k].state) contacts.push_back(k);
  return contacts;
}

/// Puts the clock on the breakpoints of this instant, if any, and notes what was changed at it. True: a load jumps
/// at one of them.
bool Loop::pass_breakpoints(Instant& now) {
  bool jumps = change_.jump;
  now.jump = change_.any;
  for (; next_breakpoint_ < breakpoints_.size() && breakpoints_[next_breakpoint_].time - t_ <= resolution_;
       ++next_breakpoint_) {
    now.jump = true;
    jumps = jumps || breakpoints_[next_breakpoint_].jump;
    t_ = breakpoints_[next_breakpoint_].time;
  }
  return jumps;
}

Point Loop::decided_point() const {
  Point point{decision_.u, decision_.v, decision_.jet.forces.col(0), decision_.jet.a()};
  engine_->know_energy(point);
  return point;
}

/// From here on the motion is that of the decision; a row asked for at t_ shows it.
/// changed: contacts whose states or velocities have; absent: perhaps all.
void Loop::take_decision(const std::optional<std::vector<std::size_t>>& changed) {
  if (decision_.undecided) ++report_.undecided;
  const bool open = decision_.forgiven > 0.0 || decision_.unresolved || !decision_.at_limit.empty();
  if (open && !report_.forgiven_at) report_.forgiven_at = t_;
  point_ = decided_point();
  auditor_.observe(forcing_, t_, decision_.mode, point_);
  last_energy_ = auditor_.energy(t_, decision_.mode, point_);
  if (const double next = samples_.next(); next <= t_) {
    works_.clear();
    samples_.emit(next, works_, forcing_, decision_.mode, point_);
    residual_due_ = true;
  }
  response_.row(t_, Side::after, point_, auditor_.losses());
  motion_.after(t_, auditor_, forcing_, decision_.mode, point_, changed);
  curves_.add(t_, point_.u, last_energy_);
}

/// The point at t; the auditor has works up to `to`.
void Loop::add_curves(double t, double to) {
  works_.clear();
  if (t < to) engine_->integrate(t, to, works_);
  curves_.add(t, point_.u, auditor_.energy_before(works_, decision_.mode, point_));
}

/// A row inside of a step; works_: from there to its end.
void Loop::emit(double t, Point& point) {
  samples_.emit(t, works_, forcing_, decision_.mode, point);
  if (response_.any()) {
    engine_->accelerate(t, point);
    std::vector<double> losses = auditor_.losses();
    for (std::size_t k = 0; k < losses.size(); ++k) losses[k] -= works_.friction[k];
    response_.row(t, Side::before, point, losses);
  }
  residual_due_ = true;
}

void Loop::warn_of_decision() {
  for (const std::size_t c : decision_.released)
    if (++releases_ <= most_gains) report_.warnings.push_back(left_at_once(model_, c, said_time(model_, t_)));
  if (!shares_)
    if (auto told = shared_motion(model_, decision_, said_time(model_, t_))) {
      report_.warnings.push_back(std::move(*told));
      shares_ = true;
    }
  for (const AtLimit& found : decision_.at_limit)
    if (++at_limit_ <= most_gains)
      report_.warnings.push_back(rest_at_limit(model_, found, said_time(model_, t_)));
  if (decision_.impact_gains && ++gains_ <= most_gains)
    report_.warnings.push_back(
        impact_gain(said_time(model_, t_), said(model_, -decision_.impact_loss, unit::energy)));
}

Ending Loop::end() {
  report_.outcome.t = t_;
  if (observer_) observer_->end(t_);
  if (observer_ && engine_->graze()) {
    Graze graze = *engine_->graze();
    graze.t = said_time(model_, graze.t);
    observer_->graze(graze);
  }
  if (observer_) {
    std::vector<NearHit> near = engine_->near_hits();
    for (NearHit& hit : near) {
      hit.t = said_time(model_, hit.t);
      hit.gap = said(model_, hit.gap, unit::length);
      hit.bend = said(model_, hit.bend, unit::acceleration);
    }
    observer_->near_hits(std::move(near));
  }
  engine_->count();
  report_.counters = engine_->counters;
  log_.finish();
  if (motion_.last() < t_) motion_.add(t_, auditor_, forcing_, decision_.mode, point_);
  if (curves_.last() < t_) add_curves(t_, t_);
  motion_.write(recorder_);
  curves_.write(recorder_);
  report_.warnings.insert(report_.warnings.end(), engine_->warnings.begin(), engine_->warnings.end());
  auditor_.finish(report_, last_energy_, t_, decision_.mode);
  // Rows of a step that leads to no instant are kept; no peak takes part in it.
  if (report_.outcome.kind == Outcome::Kind::done) witness_.peaks(t_, report_.peaks);
  report_.witness = std::move(witness_.testimony());
  report_.response = response_.extremes();
  if (auto told = large_.warning()) report_.warnings.push_back(std::move(*told));
  if (response_.coarse()) report_.warnings.push_back(*response_.coarse());
  if (!model_.reaction_sums.empty()) report_.audit.reactions = response_.reactions();
  return {std::move(report_), rounding_of_energy(), !witness_.grave().empty()};
}

/// Of u K u / 2.
double Loop::rounding_of_energy() const {
  const auto terms = [&](const Vector& u) { return 0.5 * structure_.magnitude(structure_.k, u.data()); };
  return rounding::of_many * std::max(terms(model_.u0), terms(point_.u));
}

}  // namespace signorini
