#include "study/speed/work_study.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/files.hpp"
#include "base/rounding.hpp"
#include "base/text.hpp"
#include "engine/tolerance.hpp"
#include "result/csv.hpp"
#include "run/choose_engine.hpp"
#include "run/cost_estimate.hpp"
#include "run/engines.hpp"
#include "scene/components.hpp"
#include "study/speed/work_plan.hpp"

namespace signorini::speed {

namespace fs = std::filesystem;

namespace {

/// Relative change of masses: more than one unit in the last place, less than the accuracy of any structural data.
constexpr double last_digits = 1e-15;

/// Smallest value of run.rtol that a scene may have.
constexpr double tightest_rtol = 1e-14;

/// A run is skipped if its expected duration exceeds this multiple of the time limit. Expected durations are
/// only orders of magnitude.
constexpr double max_expected_ratio = 30.0;

constexpr const char* flow_key = "run.flow";

/// A reference run may take this multiple of the time limit.
constexpr double patience = 10.0;

/// Names of folders begin with a number, because names of runs may differ in special characters only.
std::string folder_name(std::size_t number, const std::string& name) {
  return fmt::format("{:03}-{}", number, base::file_name(name, 80, ".", '-'));
}

std::vector<Override> capture_velocities(const Scene& scene, const Model& model) {
  std::vector<Override> list;
  const double velocity = engine::tolerance_of(model, scene.run).capture_velocity();
  for (const Contact& contact : model.contacts)
    if (contact.takes_impulses() && !contact.capture_velocity)
      list.push_back({"contacts." + contact.name + ".capture_velocity", base::format_number(velocity)});
  return list;
}

/// Largest range of all displacement columns in history.csv.
double greatest_motion(const fs::path& directory) {
  result::CsvReader history(directory / "history.csv");
  struct Column {
    std::size_t index;
    double least, greatest;
  };
  std::vector<Column> columns;
  for (std::size_t i = 1; i < history.header().size(); ++i) {
    const std::string& name = history.header()[i];
    if (scene::is_displacement(name) && !scene::motion_named(name).rotation)
      columns.push_back(
          {i, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()});
  }
  while (history.next())
    for (Column& column : columns) {
      column.least = std::min(column.least, history.number(column.index));
      column.greatest = std::max(column.greatest, history.number(column.index));
    }
  double motion = 0.0;
  for (const Column& column : columns) motion = std::max(motion, column.greatest - column.least);
  return motion;
}

/// A time before t that is not near an event of either run; 0 if there is no such time.
double event_free_time_before(double t, const std::vector<compare::LoggedEvent>& a,
                              const std::vector<compare::LoggedEvent>& b) {
  constexpr double near = 1e-6;  // relative to t
  std::vector<double> times = {0.0};
  for (const auto* events : {&a, &b})
    for (const compare::LoggedEvent& event : *events)
      if (event.t < t) times.push_back(event.t);
  std::sort(times.begin(), times.end(), std::greater<>());
  double after = t;
  for (const double before : times) {
    if (after - before > near * t) return 0.5 * (before + after);
    after = before;
  }
  return 0.0;
}

long changes_until(const std::vector<compare::LoggedEvent>& events, double t) {
  return std::count_if(events.begin(), events.end(),
                       [&](const compare::LoggedEvent& event) { return event.is_change() && event.t <= t; });
}

}  // namespace

const std::array<Engine, 2> WorkStudy::references = {run::engine_for(run::EngineRole::closed_form),
                                                     run::engine_for(run::EngineRole::integrator)};

WorkStudy::WorkStudy(WorkRequest request) : request_(std::move(request)) {
  const auto [scene, model] = study::prepare_run(request_.scene, request_.settings(""));
  reduction_ = scene.reduction;
  fingerprint_ = base::fingerprint_of(scene.resolved);
  capture_velocities_ = capture_velocities(scene, model);
  report_.scene = request_.scene;
  report_.title = scene.title;
  report_.units = scene.units;
  report_.machine = base::host_info();
  report_.t_end = report_.compared_until = scene.run.t_end;
  report_.repeats = request_.repeats;
  report_.unknowns = model.dofs.size();
  report_.contacts = model.contacts.size();
  if (!capture_velocities_.empty())
    report_.notes.push_back(fmt::format("rigid contacts without a capture_velocity use {} {}/{} in all runs",
                                        capture_velocities_.front().value, scene.units.length,
                                        scene.units.time));
}

study::PreparedRun WorkStudy::prepare(const WorkPoint& point) const {
  if (base::fingerprint_of(read_scene(request_.scene, request_.settings("")).resolved) != fingerprint_)
    throw FileError(request_.scene,
                    "has changed during the study, so the runs cannot be compared; start the study again");
  std::vector<Override> changes = capture_velocities_;
  for (const auto& more : {request_.settings(point.engine), point.changes()})
    changes.insert(changes.end(), more.begin(), more.end());
  // Messages show a key without an option, because no option has set the key.
  for (Override& change : changes) change.shown_as = change.path + "=" + change.value;
  return study::prepare_run(read_scene(request_.scene, changes), reduction_);
}

/// Expected duration in s; 0 for points that have run already.
double WorkStudy::seconds_of(const WorkPoint& point) const {
  if (recorded_.contains(point.name())) return 0.0;
  const study::PreparedRun run = prepare(point);
  return run::expected_cost(run.model, run.scene.run).estimate.seconds;
}

/// Records each run once. Errors: SceneError, UsageError for a varied key, FileError.
const WorkStudy::Recorded& WorkStudy::record(const WorkPoint& point, const WorkLimits& limits) {
  const auto found = recorded_.find(point.name());
  if (found != recorded_.end()) return found->second;
  const study::PreparedRun run = prepare(point);
  Recorded recorded;
  std::size_t number = recorded_.size();
  // A folder with foreign files may remain from an earlier study. Then the next number is used.
  do recorded.directory = request_.directory / "runs" / folder_name(++number, point.name());
  while (fs::exists(recorded.directory));
  const WorkOutcome outcome = record_run(run, recorded.directory, limits);
  report_.interrupted = report_.interrupted || outcome.interrupted;
  recorded.too_slow = outcome.too_slow;
  return recorded_.emplace(point.name(), std::move(recorded)).first->second;
}

bool WorkStudy::try_reference(const WorkPoint& point, std::string& why_not) {
  WorkLimits limits = request_.limits;
  limits.seconds *= patience;
  try {
    const Recorded& recorded = record(point, limits);
    if (recorded.too_slow) {
      why_not = fmt::format("it takes longer than {:g} s", limits.seconds);
      return false;
    }
    compare::ComparedRun run = compare::read_compared_run(recorded.directory, point.name());
    if (!run.figures.done())
      why_not = fmt::format("it {} at t = {:.9g}: {}", run.figures.facts.outcome, run.figures.t,
                            run.figures.reason);
    if (!report_.reference.empty() && !(run.figures.t > reference_.figures.t)) return false;
    reference_ = std::move(run);
    report_.reference = point.name();
    return reference_.figures.done();
  } catch (const SceneError& error) {
    why_not = error.what();
    return false;
  }
}

/// Measures the error of `exact` itself: the difference from the same run with all masses changed in their last digits.
void WorkStudy::measure_reference_error(const WorkPoint& point) {
  const fs::path folder = request_.directory / "runs" / "again";
  study::PreparedRun run = prepare(point);
  run.model.mass *= 1.0 + last_digits;
  WorkLimits limits = request_.limits;
  limits.seconds *= patience;
  const WorkOutcome outcome = record_run(run, folder, limits);
  report_.interrupted = report_.interrupted || outcome.interrupted;
  perturbed_reference_ = compare::read_compared_run(folder, point.name() + " again");
  reference_error_measured_ = true;
  report_.notes.push_back(
      fmt::format("the error of the reference is estimated from a second run with all masses changed by the "
                  "factor 1 + {:g}; errors below this estimate cannot be distinguished",
                  last_digits));
  double& until = report_.compared_until;
  const double whole = until;
  double decided = whole;
  while (const auto split =
             compare::align(reference_.events, perturbed_reference_.events, {until, 0.0}).split) {
    decided = split->t;
    until = event_free_time_before(split->t, reference_.events, perturbed_reference_.events);
  }
  if (until < whole)
    report_.notes.push_back(
        fmt::format("at t = {:.9g} a change of all masses in their last digits alters the sequence of "
                    "events: all runs are compared up to t = {:.9g} only",
                    decided, until));
}

/// `exact` with its Taylor series. nullopt if `exact` uses the series already, if the command line sets the
/// flow, or if the series would take too long; in the last case a note is added.
std::optional<WorkPoint> WorkStudy::series_of_exact() {
  WorkPoint series;
  series.engine = to_string(references[0]);
  const auto says_flow = [](const std::vector<Override>& list) {
    return std::any_of(list.begin(), list.end(), [](const Override& o) { return o.path == flow_key; });
  };
  if (says_flow(request_.settings(series.engine)) ||
      std::any_of(request_.ranges.varied.begin(), request_.ranges.varied.end(), says_flow))
    return std::nullopt;
  try {
    const study::PreparedRun run = prepare(series);
    if (!run::choose_flow(run.model, run.scene.run).modal) return std::nullopt;
    series.varied = {{flow_key, "taylor"}};
    const double seconds = run::expected_cost(run.model, run.scene.run).estimate.by_series;
    if (seconds <= request_.limits.seconds) return series;
    report_.notes.push_back(
        fmt::format("{} is omitted: it would take {} s, more than the time limit of {:g} s", series.name(),
                    run::seconds_text(seconds), request_.limits.seconds));
  } catch (const SceneError&) {  // the error is reported when `exact` itself runs
  }
  return std::nullopt;
}

bool WorkStudy::choose_reference() {
  std::string why_not;
  if (const auto series = series_of_exact()) {
    if (try_reference(*series, why_not)) {
      series_ = series;
      return true;
    }
    report_.notes.push_back(series->name() + " is not the reference: " + why_not);
  }
  WorkPoint exact;
  exact.engine = to_string(references[0]);
  if (try_reference(exact, why_not)) return true;
  report_.notes.push_back(exact.engine + " is not the reference: " + why_not);
  WorkPoint tight;
  tight.engine = to_string(references[1]);
  const auto& rtol = request_.ranges.rtol;
  const double least = rtol.empty() ? tightest_rtol : *std::min_element(rtol.begin(), rtol.end());
  // A tolerance below the rounding of the scene's forces cannot be met, so the next two decades are tried as well.
  for (int tries = 0; tries < 3 && !report_.interrupted; ++tries) {
    tight.accuracy = rounded_decimal(std::max(least / 10.0, tightest_rtol) * std::pow(10.0, tries));
    if (!try_reference(tight, why_not)) continue;
    report_.notes.push_back(
        fmt::format("the reference is the run with the smallest tolerance, {}: errors near this tolerance "
                    "are not reliable",
                    tight.name()));
    return true;
  }
  return false;
}

/// Sets the ranges of meaningful errors: from the error of the reference itself up to the size of the quantity.
void WorkStudy::set_error_ranges() {
  compare::ComparisonSettings settings;
  settings.t_end = report_.compared_until;
  if (reference_error_measured_) {
    const compare::Comparison doubt = compare::compare_runs(reference_, perturbed_reference_, settings);
    for (const compare::Quantity& quantity : compare::quantities(doubt, report_.units))
      if (quantity.deviation->count > 0) report_.range[quantity.name].floor = quantity.deviation->whole.value;
  }
  // Errors of event times cannot be smaller than their rounding.
  double& floor = report_.range["event_time"].floor;
  floor = std::max(floor, rounding::eps * report_.compared_until);
  const auto events = static_cast<double>(changes_until(reference_.events, report_.compared_until));
  report_.range["event_time"].most = report_.compared_until / (1.0 + events);
  report_.range["displacement"].most = greatest_motion(reference_.figures.directory);
}

void WorkStudy::find_reference() {
  const bool whole = choose_reference();
  if (report_.reference.empty()) {
    if (recorded_.empty()) throw Error(ExitCode::scene, report_.notes.back());
    report_.notes.push_back("there is no reference, so runs have times but no errors");
    return;
  }
  if (!whole) {
    report_.compared_until = reference_.figures.t;
    report_.notes.push_back(fmt::format(
        "the reference, {}, {} at t = {:.9g}: {}; all runs are compared up to this time", report_.reference,
        reference_.figures.facts.outcome, reference_.figures.t, reference_.figures.reason));
  }
  WorkPoint exact;
  exact.engine = to_string(references[0]);
  const WorkPoint& reference = series_.value_or(exact);
  if (report_.reference == reference.name() && !report_.interrupted) measure_reference_error(reference);
  set_error_ranges();
}

void WorkStudy::compare(WorkRow& row, const compare::ComparedRun& run) const {
  row.events = changes_until(run.events, report_.compared_until);
  if (report_.reference.empty()) return;
  row.events_of_reference = changes_until(reference_.events, report_.compared_until);
  row.reference = row.point.name() == report_.reference;
  row.whole = run.figures.t >= std::min(report_.compared_until, reference_.figures.t);
  if (row.reference && !reference_error_measured_) return;  // the reference has no error relative to itself
  compare::ComparisonSettings settings;
  settings.t_end = report_.compared_until;
  const compare::ComparedRun& other = row.reference ? perturbed_reference_ : run;
  set_errors(row, reference_, other, compare::compare_runs(reference_, other, settings));
}

const WorkRow& WorkStudy::add(const WorkPoint& point) {
  WorkRow row;
  row.point = point;
  try {
    if (const double seconds = seconds_of(point); seconds > max_expected_ratio * request_.limits.seconds) {
      row.outcome = "too slow";
      row.reason = fmt::format("not started: the run would take {} s", run::seconds_text(seconds));
      report_.rows.push_back(std::move(row));
      return report_.rows.back();
    }
    const Recorded& recorded = record(point, request_.limits);
    row.directory = recorded.directory;
    const compare::ComparedRun run = compare::read_compared_run(recorded.directory, point.name());
    row.outcome = recorded.too_slow ? "too slow" : run.figures.facts.outcome;
    row.reason = recorded.too_slow ? fmt::format("not complete after {:g} s", request_.limits.seconds)
                                   : run.figures.reason;
    row.t = run.figures.t;
    row.steps = run.figures.steps;
    row.factorisations = run.figures.factorisations;
    row.solves = run.figures.solves;
    row.restarts = run.figures.restarts;
    const auto balance = run.figures.audit.find("energy");
    if (balance != run.figures.audit.end()) row.balance = balance->second;
    compare(row, run);
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    row.outcome = "refused";
    row.reason = error.what();
  }
  report_.rows.push_back(std::move(row));
  return report_.rows.back();
}

void WorkStudy::time_all(const std::function<void(const WorkRow&, std::size_t round)>& before) {
  constexpr double enough = 10.0;  // s: total time after which a run is not repeated again
  constexpr double brief = 0.05;   // s: shorter runs are repeated several times per round
  constexpr int most = 10;
  for (std::size_t round = 1; round <= request_.repeats; ++round) {
    for (WorkRow& row : report_.rows) {
      if (report_.interrupted) return;
      if (row.outcome != "done" && row.outcome != "stopped") continue;
      if (std::accumulate(row.wall_times.begin(), row.wall_times.end(), 0.0) > enough) continue;
      before(row, round);
      const study::PreparedRun run = prepare(row.point);
      double least = std::numeric_limits<double>::infinity(), sum = 0.0;
      for (int i = 0; i < most && sum < brief; ++i) {
        const WorkOutcome outcome = time_run(run, request_.limits);
        report_.interrupted = outcome.interrupted;
        // The machine is busy, so the time of this repetition is not used.
        if (outcome.interrupted || outcome.too_slow) break;
        least = std::min(least, outcome.report.wall_time);
        sum += outcome.report.wall_time;
      }
      if (std::isfinite(least)) row.wall_times.push_back(least);
    }
  }
}

}  // namespace signorini::speed
