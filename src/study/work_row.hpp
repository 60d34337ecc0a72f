// work_row.hpp: what one engine with one setting costs, and how far it is off.
//
//   error = greatest difference from the reference, up to where the sequences of events part
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/comparison_files.hpp"
#include "study/work_plan.hpp"

namespace signorini {

/// The greatest error of one quantity (names and units of limits.hpp).
struct WorkError {
  std::string quantity, unit;
  double value = 0.0, t = 0.0;  ///< up to where the sequences part
  std::string where;
  double whole = 0.0;  ///< over the whole run
};

struct WorkRow {
  WorkPoint point;
  std::filesystem::path directory;  ///< of the run; empty if refused
  std::string outcome;              ///< done, stopped, refused, "too slow"
  std::string reason;               ///< empty when done
  double t = 0.0;                   ///< reached
  long events = 0, events_of_reference = 0;
  std::size_t alike = 0;          ///< events with a partner in the reference
  std::string split;              ///< how the sequences part; empty where they are the same
  std::optional<double> t_split;  ///< where
  /// The sequences part no sooner than the reference's own sequence is determined.
  bool undetermined = false;
  std::vector<WorkError> errors;
  std::vector<double> wall_times;  ///< s, of repeated runs without output
  long steps = 0, factorisations = 0, solves = 0, restarts = 0;
  double balance = 0.0;  ///< relative error of the energy balance

  /// Reached the end with the reference's sequence of events, as far as that is determined.
  [[nodiscard]] bool complete() const { return outcome == "done" && (split.empty() || undetermined); }
  [[nodiscard]] const WorkError* error(const std::string& quantity) const;
  [[nodiscard]] std::optional<double> wall_time() const;  ///< the least
};

/// Puts the differences of a run from the reference into its row.
void take_comparison(WorkRow& row, const ComparedRun& reference, const ComparedRun& run,
                     const Comparison& comparison);

}  // namespace signorini
