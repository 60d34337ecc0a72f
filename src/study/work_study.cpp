#include "study/work_study.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/number.hpp"
#include "result/run_directory.hpp"

namespace signorini {

namespace fs = std::filesystem;

namespace {

/// Smaller than any rounding of the model's own numbers would be noticed, larger than one unit.
constexpr double last_digits = 1e-15;

/// Runs of one engine are given one more decade for a reference; none below what the scene reader takes.
constexpr double tightest_rtol = 1e-13;

std::string plain(const std::string& name) {
  std::string slug;
  for (const char c : name) {
    const bool keep = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '-' || c == '.' || c == '_';
    slug += keep ? c : '-';
  }
  return slug.substr(0, 120);
}

bool same(const WorkPoint& a, const WorkPoint& b) { return a.name() == b.name(); }

std::vector<Override> capture_velocities(const Scene& scene, const Model& model) {
  std::vector<Override> list;
  const double velocity = scene.run.atol.velocity.value_or(scene.run.rtol * model.scales.velocity);
  for (const Contact& contact : model.contacts)
    if (contact.law == Law::rigid && !contact.capture_velocity)
      list.push_back({"contacts." + contact.name + ".capture_velocity", shortest(velocity)});
  return list;
}

}  // namespace

WorkStudy::WorkStudy(WorkRequest request) : request_(std::move(request)) {
  const Scene scene = read_scene(request_.scene, request_.settings(""));
  const Model model = build_model(scene);
  held_ = capture_velocities(scene, model);
  report_.scene = request_.scene;
  report_.title = scene.title;
  report_.units = scene.units;
  report_.machine = this_machine();
  report_.t_end = scene.run.t_end;
  report_.repeats = request_.repeats;
  report_.unknowns = model.dofs.size();
  report_.contacts = model.contacts.size();
  if (!held_.empty())
    report_.notes.push_back(fmt::format("rigid contacts: capture_velocity = {} {}/{} in all runs",
                                        held_.front().value, scene.units.length, scene.units.time));
}

WorkStudy::Prepared WorkStudy::prepare(const WorkPoint& point) const {
  std::vector<Override> changes = request_.settings(point.engine);
  changes.insert(changes.end(), held_.begin(), held_.end());
  const std::vector<Override> own = point.changes();
  changes.insert(changes.end(), own.begin(), own.end());
  Scene scene = read_scene(request_.scene, changes);
  Model model = build_model(scene);
  return {std::move(scene), std::move(model)};
}

fs::path WorkStudy::folder_of(const WorkPoint& point) const {
  return request_.directory / "runs" / plain(point.name());
}

bool WorkStudy::try_reference(const WorkPoint& point, std::string& why_not) {
  const fs::path folder = folder_of(point);
  try {
    const Prepared run = prepare(point);
    const WorkOutcome outcome = record_run(run.scene, run.model, folder, request_.limits);
    report_.interrupted = report_.interrupted || outcome.interrupted;
    if (outcome.too_slow) {
      why_not = fmt::format("it takes longer than {:g} s", request_.limits.seconds);
      remove_run(folder);
      return false;
    }
  } catch (const SceneError& error) {
    why_not = error.what();
    return false;
  }
  reference_ = read_compared_run(folder, point.name());
  reference_point_ = point;
  report_.reference = point.name();
  return true;
}

/// How far `exact` itself can be trusted: the same run with all masses changed in their last digits.
void WorkStudy::doubt_reference(const WorkPoint& point) {
  const fs::path folder = request_.directory / "runs" / "again";
  Prepared run = prepare(point);
  run.model.mass *= 1.0 + last_digits;
  const WorkOutcome outcome = record_run(run.scene, run.model, folder, request_.limits);
  report_.interrupted = report_.interrupted || outcome.interrupted;
  doubt_ = compare_runs(reference_, read_compared_run(folder, point.name() + " again"));
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  report_.notes.push_back(fmt::format(
      "the errors of {} are those of a second run with all masses changed in their last digits ({:g})",
      point.name(), last_digits));
  if (doubt_.alignment.split)
    report_.notes.push_back(fmt::format(
        "beyond t = {:.9g} such a change decides the sequence: events from there on are not determined in "
        "double precision, and runs that part from the reference there have lost nothing",
        doubt_.alignment.split->t));
}

void WorkStudy::find_reference() {
  choose_reference();
  if (!reference_.figures.done())
    report_.notes.push_back(
        fmt::format("the reference {} at t = {:.9g}: {}; all runs are compared up to there",
                    reference_.figures.facts.outcome, reference_.figures.t, reference_.figures.reason));
}

void WorkStudy::choose_reference() {
  std::string why_not;
  WorkPoint exact;
  exact.engine = "exact";
  if (try_reference(exact, why_not)) {
    if (!report_.interrupted) doubt_reference(exact);
    return;
  }
  std::string told = "exact is not the reference: " + why_not;
  WorkPoint tight;
  tight.engine = "ida";
  const auto& rtol = request_.ranges.rtol;
  tight.accuracy = rtol.empty() ? tightest_rtol : *std::min_element(rtol.begin(), rtol.end()) / 10.0;
  tight.accuracy = std::max(*tight.accuracy, tightest_rtol);
  // A tolerance below the rounding of the scene's own forces cannot be met; the next decades can.
  for (int tries = 0; tries < 3; ++tries, *tight.accuracy *= 10.0)
    if (try_reference(tight, why_not) && (reference_.figures.done() || report_.interrupted)) break;
  if (report_.reference.empty()) throw Error(ExitCode::scene, told + "; nor can ida be: " + why_not);
  report_.notes.push_back(std::move(told));
  report_.notes.push_back(fmt::format(
      "the reference is the tightest run, {}: errors near its own tolerance say little", report_.reference));
}

void WorkStudy::compare(WorkRow& row, const ComparedRun& run) const {
  row.events_of_reference = std::count_if(reference_.events.begin(), reference_.events.end(),
                                          [](const LoggedEvent& event) { return event.type != "time"; });
  const bool itself = same(row.point, reference_point_);
  if (itself && row.point.engine == "exact") {
    take_comparison(row, reference_, run, doubt_);
    row.undetermined = doubt_.alignment.split.has_value();
    return;
  }
  take_comparison(row, reference_, run, compare_runs(reference_, run));
  const auto& limit = doubt_.alignment.split;
  row.undetermined = limit && row.t_split && *row.t_split >= limit->t;
}

const WorkRow& WorkStudy::add(const WorkPoint& point) {
  WorkRow row;
  row.point = point;
  try {
    const fs::path folder = folder_of(point);
    if (!same(point, reference_point_)) {
      const Prepared run = prepare(point);
      const WorkOutcome outcome = record_run(run.scene, run.model, folder, request_.limits);
      report_.interrupted = report_.interrupted || outcome.interrupted;
      if (outcome.too_slow) {
        row.outcome = "too slow";
        row.reason = fmt::format("not at the end after {:g} s", request_.limits.seconds);
      }
    }
    row.directory = folder;
    const ComparedRun run = read_compared_run(folder, point.name());
    if (row.outcome.empty()) {
      row.outcome = run.figures.facts.outcome;
      row.reason = run.figures.reason;
    }
    row.t = run.figures.t;
    for (const auto& [type, count] : run.figures.events_by_type) row.events += type == "time" ? 0 : count;
    row.steps = run.figures.steps.value_or(0);
    row.factorisations = run.figures.factorisations.value_or(0);
    row.solves = run.figures.solves.value_or(0);
    row.restarts = run.figures.restarts.value_or(0);
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
  constexpr double enough = 10.0;  // seconds
  constexpr double brief = 0.05;   // a round of shorter runs holds several of them
  constexpr int most = 10;

  for (std::size_t round = 1; round <= request_.repeats; ++round) {
    for (WorkRow& row : report_.rows) {
      if (report_.interrupted) return;
      if (row.outcome != "done" && row.outcome != "stopped") continue;
      if (std::accumulate(row.wall_times.begin(), row.wall_times.end(), 0.0) > enough) continue;
      before(row, round);
      const Prepared run = prepare(row.point);
      double least = 0.0, sum = 0.0;
      for (int i = 0; i < most && sum < brief && !report_.interrupted; ++i) {
        const WorkOutcome outcome = time_run(run.scene, run.model, request_.limits);
        report_.interrupted = outcome.interrupted;
        const double time = outcome.report.wall_time;
        least = i == 0 ? time : std::min(least, time);
        sum += time;
      }
      if (!report_.interrupted) row.wall_times.push_back(least);
    }
  }
}

}  // namespace signorini
