// work_run.hpp: one run of a study: recorded once for its errors, repeated without output for its time.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "signorini/simulate.hpp"
#include "study/prepared_run.hpp"

namespace signorini {

struct WorkLimits {
  double seconds = 60.0;                              ///< wall time per run
  std::function<bool()> go_on = [] { return true; };  ///< false: the user asks for a stop
  std::vector<std::string> command_line;              ///< for the summaries of runs
};

/// Outcome of a run, with details for the study.
struct WorkOutcome {
  Report report;
  bool too_slow = false, interrupted = false;
};

/// Runs into a directory of its own. Errors: SceneError for scenes that the engine refuses; FileError.
[[nodiscard]] WorkOutcome record_run(const PreparedRun& run, const std::filesystem::path& directory,
                                     const WorkLimits& limits);

/// Same without output: there are rows at both ends only, and nothing is stored.
[[nodiscard]] WorkOutcome time_run(const PreparedRun& run, const WorkLimits& limits);

}  // namespace signorini
