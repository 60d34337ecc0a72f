#include "study/speed/work_run.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace signorini::speed {

const WorkError* WorkRow::error(const std::string& quantity) const {
  const auto found =
      std::find_if(errors.begin(), errors.end(), [&](const WorkError& e) { return e.quantity == quantity; });
  return found == errors.end() ? nullptr : &*found;
}

std::optional<double> WorkRow::wall_time() const {
  if (wall_times.empty()) return std::nullopt;
  return *std::min_element(wall_times.begin(), wall_times.end());
}

void set_errors(WorkRow& row, const compare::ComparedRun& reference, const compare::ComparedRun& run,
                const compare::Comparison& comparison) {
  const auto& split = comparison.alignment.split;
  row.matched_events = comparison.alignment.pairs.size();
  row.split = split ? compare::split_text(reference, run, *split) : "";
  row.t_split = split ? std::optional(split->t) : std::nullopt;
  row.errors.clear();
  for (const compare::Quantity& quantity : compare::quantities(comparison, reference.figures.facts.units)) {
    const compare::Deviation& deviation = *quantity.deviation;
    const bool times = quantity.name == "event_time";  // all aligned events are before the split
    const bool part = split && !times;
    if ((part ? deviation.count_until_split : deviation.count) == 0) continue;
    // If no events are aligned, only the time before the first event is comparable, which is not significant.
    if (part && comparison.alignment.pairs.empty()) continue;
    const compare::MaxDifference& greatest = part ? deviation.until_split : deviation.whole;
    row.errors.push_back(
        {quantity.name, quantity.unit, greatest.value, greatest.t, greatest.where, deviation.whole.value});
  }
}

namespace {

using Clock = std::chrono::steady_clock;

/// Ends a run after its time limit. The clock is read only at every 16th call, because a reading costs as
/// much as a short step.
class Deadline : public run::ForwardingRecorder {
 public:
  explicit Deadline(const WorkLimits& limits, Recorder* next = nullptr)
      : run::ForwardingRecorder(next), limits_(limits) {}

  bool progress(double t) override {
    if (!run::ForwardingRecorder::progress(t)) return false;
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

WorkOutcome record_run(const study::PreparedRun& run, const std::filesystem::path& directory,
                       const WorkLimits& limits) {
  result::RunDirectory recorder(directory, run.scene, run.model,
                                {.command_line = limits.command_line, .pictures = false});
  Deadline deadline(limits, &recorder);
  return deadline.outcome(run.run_to_disk(recorder, deadline).certified.report);
}

WorkOutcome time_run(const study::PreparedRun& run, const WorkLimits& limits) {
  Deadline deadline(limits);
  return deadline.outcome(run.run_in_memory(deadline));
}

}  // namespace signorini::speed
