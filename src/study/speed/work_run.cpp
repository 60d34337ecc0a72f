#include "study/speed/work_run.hpp"

#include <chrono>

#include "result/run_directory.hpp"

namespace signorini {

namespace {

using Clock = std::chrono::steady_clock;

/// Ends a run after its time. The clock is asked now and then: asking costs as much as a short step.
class Deadline : public Recorder {
 public:
  Deadline(const WorkLimits& limits, Recorder* next) : limits_(limits), next_(next) {}

  void event(const Event& event) override {
    if (next_) next_->event(event);
  }
  void sample(const Sample& sample) override {
    if (next_) next_->sample(sample);
  }
  bool progress(double t) override {
    if (next_ && !next_->progress(t)) return false;
    constexpr int seldom = 16;
    if (++calls_ % seldom != 0) return true;
    too_slow = std::chrono::duration<double>(Clock::now() - start_).count() > limits_.seconds;
    interrupted = !limits_.go_on();
    return !too_slow && !interrupted;
  }

  bool too_slow = false, interrupted = false;

 private:
  const WorkLimits& limits_;
  Recorder* next_;
  Clock::time_point start_ = Clock::now();
  int calls_ = 0;
};

WorkOutcome simulated(const Model& model, const RunSpec& settings, const WorkLimits& limits, Recorder* next) {
  Deadline deadline(limits, next);
  WorkOutcome outcome{simulate(model, settings, deadline)};
  outcome.too_slow = deadline.too_slow;
  outcome.interrupted = deadline.interrupted;
  return outcome;
}

}  // namespace

WorkOutcome record_run(const PreparedRun& run, const std::filesystem::path& directory,
                       const WorkLimits& limits) {
  RunDirectory recorder(directory, run.scene, run.model, {false, limits.command_line});
  WorkOutcome outcome = simulated(run.model, run.scene.run, limits, &recorder);
  recorder.finish(outcome.report);
  return outcome;
}

WorkOutcome time_run(const PreparedRun& run, const WorkLimits& limits) {
  return simulated(run.model, without_rows(run.scene.run), limits, nullptr);
}

}  // namespace signorini
