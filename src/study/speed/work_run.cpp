#include "study/speed/work_run.hpp"

#include <chrono>
#include <utility>

namespace signorini {

namespace {

using Clock = std::chrono::steady_clock;

/// Ends a run after its time. The clock is asked now and then: asking costs as much as a short step.
class Deadline : public ForwardingRecorder {
 public:
  explicit Deadline(const WorkLimits& limits, Recorder* next = nullptr)
      : ForwardingRecorder(next), limits_(limits) {}

  bool progress(double t) override {
    if (!ForwardingRecorder::progress(t)) return false;
    constexpr int seldom = 16;
    if (++calls_ % seldom != 0) return true;
    too_slow_ = std::chrono::duration<double>(Clock::now() - start_).count() > limits_.seconds;
    interrupted_ = !limits_.go_on();
    return !too_slow_ && !interrupted_;
  }

  [[nodiscard]] WorkOutcome outcome(Report report) const {
    return {std::move(report), too_slow_, interrupted_};
  }

 private:
  const WorkLimits& limits_;
  Clock::time_point start_ = Clock::now();
  int calls_ = 0;
  bool too_slow_ = false, interrupted_ = false;
};

}  // namespace

WorkOutcome record_run(const PreparedRun& run, const std::filesystem::path& directory,
                       const WorkLimits& limits) {
  RunDirectory recorder(directory, run.scene, run.model,
                        {.command_line = limits.command_line, .pictures = false});
  Deadline deadline(limits, &recorder);
  return deadline.outcome(run.keep(recorder, deadline).certified.report);
}

WorkOutcome time_run(const PreparedRun& run, const WorkLimits& limits) {
  Deadline deadline(limits);
  return deadline.outcome(run.ends(deadline));
}

}  // namespace signorini
