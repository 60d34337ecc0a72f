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
  double seconds = 60.0;                              ///< of wall time, a run
  std::function<bool()> go_on = [] { return true; };  ///< false: the user asks for a stop
  std::vector<std::string> command_line;              ///< for the summaries of runs
};

/// How a run ended, with what only a study knows.
struct WorkOutcome {
  Report report;
  bool too_slow = false, interrupted = false;
};

/// Runs into a directory of its own. Errors: SceneError for what an engine refuses; FileError.
[[nodiscard]] WorkOutcome record_run(const PreparedRun& run, const std::filesystem::path& directory,
                                     const WorkLimits& limits);

/// The same without output: there are rows at both ends only, and nothing is kept.
[[nodiscard]] WorkOutcome time_run(const PreparedRun& run, const WorkLimits& limits);

}  // namespace signorini
