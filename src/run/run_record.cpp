#include "run/run_record.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/tolerance.hpp"

namespace signorini::run {
namespace {

/// Contacts whose guards were triggered, or whose states have changed.
std::vector<std::size_t> changed_contacts(const RunInstant& now) {
  std::vector<std::size_t> contacts = decide::contacts_of(now.triggered);
  for (std::size_t k = 0; k < now.states_before.size(); ++k)
    if (now.after.states[k].state != now.states_before[k].state) contacts.push_back(k);
  return contacts;
}

}  // namespace

RunRecord::RunRecord(const Model& model, const RunSpec& run, const Method& method,
                     const linear::SystemMatrices& structure, const engine::Stepper& engine,
                     Recorder& recorder, Report& report, FaultInjector* faults, const PartShare& share)
    : model_(model),
      engine_(engine),
      recorder_(recorder),
      report_(report),
      faults_(faults),
      law_checker_(
          exact_model(faults),
          checked_engine(run, engine::tolerance_of(model, run), method.flow, engine.resolves_low_flights),
          recorder),
      auditor_(model, structure),
      log_(model, recorder, report, share.whole()),
      samples_(model, run, auditor_, recorder, share.grid),
      motion_(model, run.t_end, recorder, share),
      curves_(model, run.t_end, recorder, share),
      response_(model, run.t_end, recorder, engine_info(run.engine).accuracy != Accuracy::step),
      large_(model),
      warnings_(model),
      works_(model.contacts.size()) {}

const Model& RunRecord::exact_model(FaultInjector* faults) {
  if (faults == nullptr) return model_;
  exact_model_ = std::make_unique<Model>(model_);
  faults->correct(*exact_model_);
  return *exact_model_;
}

void RunRecord::begin(const RunInstant& start) {
  const double t = start.t;
  point_ = *start.point_after;
  for (std::string& sentence : shear_limit_warnings(model_, start.after))
    report_.warnings.push_back(std::move(sentence));
  warnings_.add(t, start.after, report_.warnings);
  auditor_.begin(start.after, start.states_before, start.forcing_after, *start.point_after);
  log_.start({t, start.resolution, &start.after, &start.states_before, false}, engine_);
  zero_since_.update(t, start.after, true);
  const motion::Point given{model_.u0, model_.v0, start.after.jet.forces.col(0)};
  RunLawChecker::Instant seen{t,
                              start.resolution,
                              &given,
                              &start.states_before,
                              &start.forcing_before,
                              &start.forcing_after,
                              &start.after,
                              &log_.latest()};
  seen.start = true;
  law_checker_.instant(seen);
  after(start, std::nullopt);
}

void RunRecord::step(const RunStep& step) {
  condition_ = step.facts.eigenvector_condition;
  const double begin = step.step.begin;
  works_.clear();
  step.motion.integrate(begin, step.step.end, works_);
  auditor_.add(works_);
  const double end = rows(step);
  response_.search_step(step.motion, begin, end);
  const bool each_alone =
      step.facts.contact_turning_points != nullptr && !motion_.enabled() && !curves_.enabled();
  std::span<const double> turning_points = step.facts.turning_points;
  const auto inside = std::upper_bound(turning_points.begin(), turning_points.end(), end);
  turning_points = turning_points.first(static_cast<std::size_t>(inside - turning_points.begin()));
  motion_.step(begin, end, each_alone ? std::span<const double>() : turning_points);
  if (each_alone) turns(step, end);
  const contact::ContactStates& states = step.decision.states;
  while (const auto moment = motion_.next()) {
    const double t = moment->t;
    step.motion.evaluate_watched(t, std::nullopt, point_);
    if (moment->is_turning_point && records_interior_peaks())
      auditor_.observe(step.forcing, t, states, point_);
    if (moment->is_turning_point) law_checker_.observe(t, step.forcing, point_);
    motion_.add(t, auditor_, step.forcing, states, point_);
    if (curves_.needs_row(t)) add_curves(t, states, point_, &step);
    motion_.adapt(t, curves_.requested_spacing());
  }
}

/// Records the rows requested inside a step. Returns the end of the step, or the time of the row at which the recorder ends
/// the run: nothing after this row is recorded, however long the step is.
double RunRecord::rows(const RunStep& step) {
  for (double t = samples_.next(); t < step.step.end; t = samples_.next()) {
    motion::Point point;
    step.motion.evaluate(t, point);
    works_.clear();
    step.motion.integrate(t, step.step.end, works_);
    row(step, t, point);
    law_checker_.observe(t, step.forcing, point);
    if (recorder_.progress(t)) continue;
    works_.reverse();  // the work after this row, which the auditor has received already
    auditor_.add(works_);
    stopped_at_ = t;
    return t;
  }
  return step.step.end;
}

/// Records a row at t. Before the call, works_ must contain the work from t to the end of the step.
void RunRecord::row(const RunStep& step, double t, motion::Point& point) {
  samples_.emit(t, works_, step.forcing, step.decision.states, point);
  if (response_.has_outputs()) {
    step.motion.accelerate(t, point);
    std::vector<double> losses = auditor_.friction_losses();
    for (std::size_t k = 0; k < losses.size(); ++k) losses[k] -= works_.friction[k];
    response_.row(t, motion::Side::before, point, losses);
  }
  residual_due_ = true;
}

/// Audits each contact at its own turning points; used if no motion is drawn.
void RunRecord::turns(const RunStep& step, double end) {
  for (const events::TurningPointDetector::TurningPoint& turn : *step.facts.contact_turning_points) {
    if (!std::isfinite(turn.time) || turn.time > end) continue;
    const std::size_t contact = turn.contact();
    step.motion.evaluate_watched(turn.time, contact, point_);
    if (records_interior_peaks())
      auditor_.observe(contact, step.forcing, turn.time, step.decision.states, point_);
    law_checker_.observe(contact, turn.time, step.forcing, point_);
  }
}

void RunRecord::reached(const RunStep& step, const RunPoint& end) {
  large_.examine(end.t, end.forcing, end.point);
  if (step.step.kind == engine::Step::Kind::event) return;
  if (motion_.needs_row(end.t)) motion_.add(end.t, auditor_, end.forcing, end.states, end.point);
  if (curves_.needs_row(end.t)) {
    add_curves(end.t, end.states, end.point);
    motion_.adapt(end.t, curves_.requested_spacing());
  }
  auditor_.observe(end.forcing, end.t, end.states, end.point);
  law_checker_.between(end.t, end.forcing, end.states, end.point, condition_);
  if (std::exchange(residual_due_, false)) auditor_.equilibrium(end.t, step.motion.residual());
}

void RunRecord::before(const RunPoint& point) {
  motion_.before(point.t, auditor_, point.forcing, point.states, point.point);
  if (curves_.enabled()) add_curves(point.t, point.states, point.point);
}

void RunRecord::instant(const RunInstant& now) {
  const double t = now.t;
  if (now.breakpoint || now.after.states != now.states_before || !now.after.impulses.empty())
    response_.before(t, *now.point_before, auditor_.friction_losses());
  auditor_.instant(t, now.after, now.states_before, *now.point_before, now.forcing_after, now.load_jumps);
  warnings_.add(t, now.after, report_.warnings);
  log_.instant({t, now.resolution, &now.after, &now.states_before, now.load_jumps,
                zero_since_.zero_durations(t, now.triggered)},
               engine_);
  zero_since_.update(t, now.after, now.breakpoint);
  law_checker_.instant({t, now.resolution, now.point_before, &now.states_before, &now.forcing_before,
                        &now.forcing_after, &now.after, &log_.latest(), false, now.breakpoint, now.load_jumps,
                        now.adopted, condition_});
  after(now, now.breakpoint ? std::nullopt : std::optional(changed_contacts(now)));
}

/// Records the side after an instant; a row requested at this time shows this side. changed: contacts whose states or
/// velocities have changed; nullopt: possibly all.
void RunRecord::after(const RunInstant& now, const std::optional<std::vector<std::size_t>>& changed) {
  const double t = now.t;
  const decide::Decision& decision = now.after;
  const motion::Point& point = *now.point_after;
  const motion::Forcing& forcing = now.forcing_after;
  if (decision.undecided) ++report_.undecided;
  const bool open = decision.tolerated_violation > 0.0 || decision.unresolved || !decision.at_limit.empty();
  if (open && !report_.first_undecided) report_.first_undecided = t;
  auditor_.observe(forcing, t, decision.states, point);
  last_energy_ = auditor_.energy(t, decision.states, point);
  if (const double next = samples_.next(); next <= t) {
    works_.clear();
    samples_.emit(next, works_, forcing, decision.states, point);
    residual_due_ = true;
  }
  response_.row(t, motion::Side::after, point, auditor_.friction_losses());
  motion_.after(t, auditor_, forcing, decision.states, point, changed);
  curves_.add(t, point.u, last_energy_);
}

/// Adds a row of curves at t. step: the step that contains t, if the auditor has received the work of this step already.
void RunRecord::add_curves(double t, const contact::ContactStates& states, const motion::Point& point,
                           const RunStep* step) {
  works_.clear();
  const double end = step != nullptr ? stopped_at_.value_or(step->step.end) : t;
  if (t < end) step->motion.integrate(t, end, works_);
  curves_.add(t, point.u, auditor_.energy_before(works_, states, point));
}

Sample RunRecord::sample(const RunPoint& now) {
  works_.clear();
  return samples_.sample(now.t, works_, now.forcing, now.states, now.point);
}

void RunRecord::end(const RunPoint& last, const engine::StepperReport& engine) {
  report_.counters = engine.counters;
  log_.finish();
  if (motion_.last() < last.t) motion_.add(last.t, auditor_, last.forcing, last.states, last.point);
  if (curves_.last() < last.t) add_curves(last.t, last.states, last.point);
  motion_.write(recorder_);
  curves_.write(recorder_);
  report_.warnings.insert(report_.warnings.end(), engine.warnings.begin(), engine.warnings.end());
  auditor_.finish(report_, last_energy_, last.t, last.states);
  // If the run stopped, rows of its last step may exceed the peaks, which do not include this step.
  if (report_.outcome.kind == Outcome::Kind::done) law_checker_.peaks(last.t, report_.peaks);
  report_.law_checks = std::move(law_checker_.law_checks());
  report_.response = response_.extremes();
  if (auto sentence = large_.warning()) report_.warnings.push_back(std::move(*sentence));
  if (response_.coarse_warning()) report_.warnings.push_back(*response_.coarse_warning());
  if (!model_.reaction_sums.empty()) report_.audit.reactions = response_.reactions();
}

}  // namespace signorini::run
