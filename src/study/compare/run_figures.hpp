// run_figures.hpp: figures of a run, read from its directory, for tables of several runs.
//
//   RunFigures run = read_run_figures("pipeline-run");
//   std::vector<LoggedEvent> events = read_events(run.directory);
//
// If a run stopped early, was interrupted or was killed, some of its figures are absent.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "result/summary.hpp"
#include "study/compare/alignment.hpp"

namespace signorini::compare {

struct RunFigures {
  std::string name;  ///< name in tables: the engine, or the directory as given
  std::filesystem::path directory;
  result::RunFacts facts;      ///< outcome: done, stopped, interrupted, running
  std::string engine, reason;  ///< reason: why the run ended early; empty if it is done
  double t = 0.0;              ///< time that the run reached; the last output time if the summary has none
  std::optional<double> wall_time;
  std::optional<long> steps, factorisations, solves, restarts;
  std::map<std::string, long> events_by_type;
  std::map<std::string, double> audit;  ///< relative violations, by their names in summary.json
  std::map<std::string, double> friction_work;
  std::optional<double> friction, damping;  ///< total energy dissipated by friction and by damping

  [[nodiscard]] bool done() const { return facts.outcome == "done"; }
};

/// Reads the figures of the run in this directory. Errors: FileError if there is no run.
[[nodiscard]] RunFigures read_run_figures(const std::filesystem::path& directory);

/// The rows of events.csv. Errors: FileError.
[[nodiscard]] std::vector<LoggedEvent> read_events(const std::filesystem::path& directory);

}  // namespace signorini::compare
