// work_row.hpp: what one engine with one setting costs, and how far it is off.
//
//   error = greatest difference from the reference, up to where the sequences of events part
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/compare/comparison_files.hpp"
#include "study/speed/work_plan.hpp"

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
  std::filesystem::path directory;                  ///< of the run; empty if refused
  std::string outcome;                              ///< done, stopped, refused, "too slow"
  bool reference = false;                           ///< the others' errors are against this run
  std::string reason;                               ///< empty when done
  std::optional<double> t;                          ///< reached
  bool whole = false;                               ///< reached the end of the reference
  std::optional<long> events, events_of_reference;  ///< up to where runs are compared
  std::size_t alike = 0;                            ///< events with a partner in the reference
  std::string split;                                ///< how the sequences part; empty where they are the same
  std::optional<double> t_split;                    ///< where

  std::vector<WorkError> errors;
  std::vector<double> wall_times;  ///< s, of repeated runs without output
  std::optional<long> steps, factorisations, solves, restarts;
  std::optional<double> balance;  ///< relative error of the energy balance

  /// Reached the end with the reference's sequence of events.
  [[nodiscard]] bool complete() const { return outcome == "done" && whole && split.empty(); }
  [[nodiscard]] const WorkError* error(const std::string& quantity) const;
  [[nodiscard]] std::optional<double> wall_time() const;  ///< the least
};

/// Puts the differences of a run from the reference into its row.
void take_comparison(WorkRow& row, const ComparedRun& reference, const ComparedRun& run,
                     const Comparison& comparison);

}  // namespace signorini
