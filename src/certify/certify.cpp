#include "signorini/certify.hpp"

#include <fmt/core.h>
#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <csignal>
#include <exception>
#include <list>
#include <mutex>
#include <thread>

#include "base/host_info.hpp"
#include "certify/companion.hpp"
#include "certify/data_perturbation.hpp"
#include "certify/error_bounds.hpp"
#include "certify/event_matcher.hpp"
#include "motion/point.hpp"
#include "run/choose_engine.hpp"
#include "run/cost_estimate.hpp"
#include "run/engines.hpp"
#include "run/run_law_checker.hpp"
#include "run/run_listener.hpp"

namespace signorini {
namespace {

/// For run.certify = "auto": a run is certified if its companions cost less than this fraction of the run.
constexpr double cheap = 0.5;
/// A companion that was not requested ends after `patience` times the expected number of steps, but not before
/// least_steps, since the expected number does not include events.
constexpr double patience = 20.0, least_steps = 1e5;
/// A companion that takes no longer than this always runs to its end. Unit: seconds.
constexpr double free_seconds = 0.5;
constexpr std::chrono::milliseconds progress_interval{50};

/// A thread with all signals blocked, so that the calling thread receives all signals.
class SignalBlockedThread {
 public:
  template <class Work>
  explicit SignalBlockedThread(Work work) {
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before);
    try {
      thread_ = std::thread(std::move(work));
    } catch (...) {
      pthread_sigmask(SIG_SETMASK, &before, nullptr);
      throw;
    }
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }
  ~SignalBlockedThread() { thread_.join(); }
  SignalBlockedThread(const SignalBlockedThread&) = delete;
  SignalBlockedThread& operator=(const SignalBlockedThread&) = delete;

 private:
  std::thread thread_;
};

std::optional<certify::EventSequence::FirstViolation> first_violation_of(const Report& report,
                                                                         const Model& model,
                                                                         const std::string& where = "") {
  if (report.law_checks.violations.empty()) return std::nullopt;
  const Violation& first = report.law_checks.violations.front();
  return certify::EventSequence::FirstViolation{first.t, where + run::sentence_of(first, model)};
}

/// Listener of a companion run: collects near hits and the first graze, and shifts located events.
class CompanionWatch final : public run::RunListener, public run::EventShift {
 public:
  CompanionWatch(const certify::CompanionRun& run, certify::CompanionTracker& tracker)
      : tracker_(tracker), seed_(run.seed), moved_(run.event_shift) {}
  /// Passes the shift of this event to the tracker, which subtracts it: only the effect of the shift on later events is
  /// a difference of the runs.
  void instant(const run::RunInstant& instant) override {
    tracker_.event_shift = instant.triggered.empty() ? 0.0 : by_ / instant.t;
  }
  void end(const run::RunPoint& /*last*/, const engine::StepperReport& engine) override {
    first = engine.graze;
    near = engine.near_hits;
  }
  double shift(const engine::Step& step) override {
    const double length = step.end - step.begin;
    const double hidden = step.resolution - motion::resolution_at(step.end, length);
    by_ = 0.0;
    if (moved_ > 0.0 && hidden > 0.0)
      by_ = certify::random_sign(seed_, ++events_) * std::min(moved_ * hidden, 0.5 * length);
    return by_;
  }
  /// Requests random step lengths, which give independent samples of the accumulated rounding errors of steps.
  [[nodiscard]] run::ListenerNeeds needs() const { return {nullptr, true, seed_}; }
  std::optional<events::Graze> first;
  std::vector<events::NearHit> near;

 private:
  certify::CompanionTracker& tracker_;
  std::uint64_t seed_, events_ = 0;
  double moved_, by_ = 0.0;
};

/// One companion run, from beginning to end.
class CompanionTask {
 public:
  CompanionTask(certify::CompanionRun run, const certify::CompanionLimit& leash, double most_steps,
                bool forces)
      : run_(std::move(run)), tracker_(run_.model, forces), guard_monitor_(run_, tracker_) {
    tracker_.limit = &leash;
    tracker_.max_steps = most_steps;
  }

  /// Runs the companion. Stores errors instead of throwing them, because an error of a companion does not end the run.
  void compute() {
    try {
      report_ = run::simulate(run_.model, run_.run, tracker_, guard_monitor_, guard_monitor_.needs(),
                              &guard_monitor_);
    } catch (const std::exception& error) {
      failure_ = error.what();
    }
  }

  [[nodiscard]] double wall_time() const { return report_.wall_time; }
  [[nodiscard]] certify::EventSequence track() {
    certify::EventSequence track{std::move(tracker_.events),
                                 report_.outcome.t,
                                 "",
                                 report_.first_undecided,
                                 guard_monitor_.first,
                                 first_violation_of(report_, run_.model, "in the companion, "),
                                 engine_info(run_.run.engine).accuracy == Accuracy::rounding};
    if (!failure_.empty()) {
      track.reached = 0.0;
      track.stop = "the companion failed: " + failure_;
    } else if (tracker_.too_long) {
      track.stop =
          "the companion took far longer than expected and was stopped; --certify lets it run to the end";
    } else if (report_.outcome.kind == Outcome::Kind::stopped) {
      track.stop = "the companion stopped: " + report_.outcome.reason;
    } else if (report_.outcome.kind == Outcome::Kind::interrupted) {
      track.stop = "the companion was interrupted together with the run";
    }
    return track;
  }
  [[nodiscard]] certify::RecordedRun kept() const { return {&tracker_.rows, &report_}; }
  [[nodiscard]] const std::vector<events::NearHit>& near_hits() const { return guard_monitor_.near; }

 private:
  certify::CompanionRun run_;
  certify::CompanionTracker tracker_;
  CompanionWatch guard_monitor_;
  Report report_;
  std::string failure_;
};

/// All companions of a run. They run in parallel to the run, limited by the number of processors; after the end of the
/// run they may also use its processor.
class Companions {
 public:
  Companions(std::vector<certify::CompanionRun> runs, double most_steps, bool forces) {
    for (certify::CompanionRun& run : runs)
      tasks_.push_back(std::make_unique<CompanionTask>(std::move(run), limit_, most_steps, forces));
  }
  ~Companions() { limit_.stop(); }
  Companions(const Companions&) = delete;
  Companions& operator=(const Companions&) = delete;

  /// Starts as many companions as there are processors, except one processor for the run.
  void begin() {
    const std::size_t beside = std::min(tasks_.size(), base::processor_count() - 1);
    while (threads_.size() < beside) start();
  }
  /// Limits companions to the time that the run has reached, and waits until all have ended. If go_on returns false,
  /// companions are stopped immediately.
  void finish(double reached, bool interrupted, const std::function<bool()>& go_on) {
    limit_.stop_at(reached);
    if (interrupted) limit_.stop();
    if (threads_.size() < tasks_.size()) start();
    std::unique_lock lock(mutex_);
    while (!ended_.wait_for(lock, progress_interval, [this] { return done_ == tasks_.size(); }))
      if (!go_on()) limit_.stop();
  }

  [[nodiscard]] const std::vector<std::unique_ptr<CompanionTask>>& tasks() const { return tasks_; }

 private:
  void start() {
    threads_.emplace_back([this] { compute(); });
  }
  void compute() {
    for (std::size_t mine = next_++; mine < tasks_.size(); mine = next_++) {
      tasks_[mine]->compute();
      const std::lock_guard lock(mutex_);
      ++done_;
      ended_.notify_all();
    }
  }

  certify::CompanionLimit limit_;
  std::vector<std::unique_ptr<CompanionTask>> tasks_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::condition_variable ended_;
  std::size_t done_ = 0;  // guarded by mutex_
  // The last member, so that threads are joined before other members are destroyed.
  std::list<SignalBlockedThread> threads_;
};

/// True if the plan is cheap enough to certify the run automatically.
bool costs_little_to_certify(const certify::CompanionPlan& plan) {
  return plan.cost > 0.0 && plan.cost < cheap;
}

/// True if companions are expected to take more than free_seconds and longer than the run has taken. Before the run, the number
/// of its steps is an upper estimate: `ida` takes few steps while the highest modes are at rest. The time of the run is computed
/// from its number of steps, not from the clock, so that the same scene is certified on every machine.
bool costs_more_than_the_run(const RunSpec& run, const certify::CompanionPlan& plan, const Report& report) {
  if (plan.engine == run.engine || !(plan.run_steps > 0.0)) return false;
  const double taken = plan.run_seconds * static_cast<double>(report.counters.steps) / plan.run_steps;
  return plan.seconds > std::max(free_seconds, taken);
}

/// Reason why the run is not certified. If run and companion use the same engine, the message gives their cost ratio. For
/// different engines this ratio is not known well, so the message gives durations; the estimate includes the restarts
/// that the run has counted.
std::string why_not(const Model& model, const RunSpec& run, const certify::CompanionPlan& plan,
                    const Report& report) {
  if (!(plan.cost > 0.0))
    return "the cost of a companion run cannot be estimated for this scene; --certify starts one";
  if (plan.engine == run.engine)
    return fmt::format(
        "a companion run would take about {:.2g} times as long as the run; --certify starts one", plan.cost);
  double seconds = plan.seconds;
  if (run::engine_row(plan.engine).capabilities.closed_form_flow)
    seconds += static_cast<double>(report.counters.restarts) * run::seconds_of_event(model);
  return fmt::format(
      "a companion run ({}) would take {} s (order of magnitude), but the run took only {:.2g} s; "
      "--certify starts one",
      plan.name, run::seconds_text(seconds), report.wall_time);
}

Certificate certificate_of(const Model& model, const RunSpec& run, const certify::CompanionPlan& plan,
                           Companions& companions, certify::CompanionTracker& own, const Report& report) {
  Certificate result;
  result.companion = plan.name;
  result.choice = plan.choice;
  result.factor = plan.factor;
  std::vector<certify::EventSequence> tracks;
  std::vector<certify::RecordedRun> kept;
  const certify::RecordedRun kept_run{&own.rows, &report};
  for (const auto& task : companions.tasks()) {
    tracks.push_back(task->track());
    kept.push_back(task->kept());
    const auto open =
        certify::first_undecided_impact(model, kept_run, kept.back(), task->near_hits(), plan.factor);
    if (std::optional<certify::EventSequence::FirstViolation>& first = tracks.back().first_violation;
        open && (!first || open->t < first->t))
      first = open;
    result.wall_time += task->wall_time();
  }
  std::vector<std::string> names;
  for (const Contact& contact : model.contacts) names.push_back(contact.name);
  for (certify::TimedEvent& event : own.events) event.uncertainty *= static_cast<float>(plan.local);
  const certify::EventSequence track{
      std::move(own.events),
      report.outcome.t,
      "",
      report.first_undecided,
      {},
      plan.limitation.empty() ? first_violation_of(report, model)
                              : std::optional(certify::EventSequence::FirstViolation{0.0, plan.limitation})};
  certify::MatchResult verdict = certify::match_events(
      track, tracks, plan.factor, names, engine_info(run.engine).accuracy == Accuracy::rounding);
  certify::BoundSettings settings{plan.factor, engine::tolerance_of(model, run)};
  if (engine_info(run.engine).accuracy != Accuracy::tolerance) settings.tolerance = {};
  result.history = certify::bound_history(model, kept_run, kept, settings, track.events, verdict);
  result.until = verdict.until;
  result.complete = verdict.reason.empty();
  result.reason = std::move(verdict.reason);
  result.first_uncertain = verdict.first_uncertain;
  result.t_errors = std::move(verdict.t_errors);
  result.unordered = verdict.unordered;
  certify::bound_extremes(result, kept_run, kept, settings);
  return result;
}

}  // namespace

std::size_t Certificate::certain_events() const {
  return static_cast<std::size_t>(
      std::count_if(t_errors.begin(), t_errors.end(), [](double e) { return !std::isnan(e); }));
}

namespace {

/// simulate_certified() without CertifiedReport::reduction.
CertifiedReport certified_run(const Model& model, const RunSpec& settings, Recorder& recorder,
                              const CertifyOptions& options) {
  using Clock = std::chrono::steady_clock;
  CertifiedReport result;
  const auto plain = [&] { result.report = simulate(model, settings, recorder, options.listener); };
  if (settings.certify == Certify::no) {
    plain();
    result.reason = "run.certify = false";
    return result;
  }
  if (recorder.steers()) {
    plain();
    result.reason = "loads change during the run through an observer, which a companion run cannot follow";
    return result;
  }
  RunSpec run = settings;
  run.engine = run::choose_engine(model, settings).engine;
  run::engine_row(run.engine).refuse(model, run);
  certify::CompanionPlan plan = certify::plan_companion(model, run);
  if (run.certify != Certify::yes && !costs_little_to_certify(plan)) {
    plain();
    result.reason = why_not(model, run, plan, result.report);
    return result;
  }
  const double most_steps = run.certify == Certify::yes ? std::numeric_limits<double>::infinity()
                                                        : std::max(least_steps, patience * plan.steps);
  if (options.forces)
    for (certify::CompanionRun& companion : plan.runs) companion.model.outputs = model.outputs;
  certify::CompanionTracker own(model, options.forces, &recorder);
  Companions companions(std::move(plan.runs), most_steps, options.forces);
  companions.begin();
  result.report = simulate(model, settings, own, options.listener);
  if (run.certify != Certify::yes && costs_more_than_the_run(run, plan, result.report)) {
    result.reason = why_not(model, run, plan, result.report);
    return result;
  }
  const Outcome& outcome = result.report.outcome;
  const auto ended = Clock::now();
  companions.finish(outcome.t, outcome.kind == Outcome::Kind::interrupted, options.go_on);
  result.certificate = certificate_of(model, run, plan, companions, own, result.report);
  result.certificate->wait = std::chrono::duration<double>(Clock::now() - ended).count();
  return result;
}

}  // namespace

CertifiedReport simulate_certified(const Model& model, const RunSpec& settings, Recorder& recorder,
                                   const CertifyOptions& options) {
  CertifiedReport result = certified_run(model, settings, recorder, options);
  if (model.reduction)
    result.reduction = certify::truncation_of(model, *model.reduction, result.report.peaks);
  if (result.certificate) result.certificate->reduction = result.reduction;
  return result;
}

}  // namespace signorini
