// work_run.hpp: one run of a study. It is recorded once to determine errors, and repeated without output to
// measure time.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "signorini/simulate.hpp"
#include "study/compare/comparison_files.hpp"
#include "study/prepared_run.hpp"
#include "study/speed/work_plan.hpp"

namespace signorini::speed {

/// The largest error of one quantity: its largest difference from the reference (names and units of
/// limits.hpp).
struct WorkError {
  std::string quantity, unit;
  /// Largest difference, and its time, up to the first difference of the sequences.
  double value = 0.0, t = 0.0;
  std::string where;
  double whole = 0.0;  ///< largest difference over the whole run
};

struct WorkRow {
  WorkPoint point;
  std::filesystem::path directory;  ///< directory of the run; empty if refused
  std::string outcome;              ///< done, stopped, refused, "too slow"
  /// True if the errors of all other runs are differences from this run.
  bool reference = false;
  std::string reason;                               ///< reason for another outcome than "done"
  std::optional<double> t;                          ///< time that the run reached
  bool whole = false;                               ///< true if the run reached the end of the reference
  std::optional<long> events, events_of_reference;  ///< numbers of events within the compared time
  std::size_t matched_events = 0;                   ///< number of events with a partner in the reference
  /// First difference of the sequences; empty if they are equal.
  std::string split;
  std::optional<double> t_split;  ///< time of the first difference

  std::vector<WorkError> errors;
  std::vector<double> wall_times;  ///< in s, of the repeated runs without output
  std::optional<long> steps, factorisations, solves, restarts;
  std::optional<double> balance;  ///< relative error of the energy balance

  /// True if the run reached the end with the reference's sequence of events.
  [[nodiscard]] bool complete() const { return outcome == "done" && whole && split.empty(); }
  [[nodiscard]] const WorkError* error(const std::string& quantity) const;
  [[nodiscard]] std::optional<double> wall_time() const;  ///< the smallest of wall_times
};

/// Sets errors and matched events of `row` from the comparison of `run` with the reference.
void set_errors(WorkRow& row, const compare::ComparedRun& reference, const compare::ComparedRun& run,
                const compare::Comparison& comparison);

struct WorkLimits {
  double seconds = 60.0;                              ///< wall time per run
  std::function<bool()> go_on = [] { return true; };  ///< returns false if the user interrupts the study
  std::vector<std::string> command_line;              ///< stored in the summaries of the runs
};

/// Outcome of a run, with details for the study.
struct WorkOutcome {
  Report report;
  bool too_slow = false, interrupted = false;
};

/// Runs and stores the results in `directory`. Errors: SceneError for scenes that the engine refuses; FileError.
[[nodiscard]] WorkOutcome record_run(const study::PreparedRun& run, const std::filesystem::path& directory,
                                     const WorkLimits& limits);

/// Runs in memory to measure the time, with output rows at both ends only.
[[nodiscard]] WorkOutcome time_run(const study::PreparedRun& run, const WorkLimits& limits);

}  // namespace signorini::speed
