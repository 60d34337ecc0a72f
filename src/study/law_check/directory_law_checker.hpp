// directory_law_checker.hpp: law check of a run from its files alone (docs/theory-checks.md, "The witness").
//
//   run.toml -> model;   summary.json -> engine;   instants.csv, events.csv -> src/law_check, instant by instant
//   contacts.csv   each row: state of the last instant, guards of this state, forces of this state
//   summary.json   as many events of each type as in events.csv; peaks at least as large as the values in the rows
//
//   DirectoryLawCheck found = check_directory_laws("pipeline-run");
//
// The law-check result in summary.json is not read. Errors: FileError for files that are missing, cut or no tables of a run,
// SceneError for run.toml.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "signorini/result.hpp"

namespace signorini::directory_check {

/// Result of the check. The first hundred violations are listed, in the units of the scene. For violations
/// found in tables Violation::event is the name of the table.
struct DirectoryLawCheck {
  Model model;
  /// Numbers of checked instants, events and rows; rows: of contacts.csv and motion.csv.
  long instants = 0, events = 0, rows = 0;
  bool complete = true;  ///< true if the run had ended
  LawCheckSummary law_checks;
};

/// Checks the run in this directory.
[[nodiscard]] DirectoryLawCheck check_directory_laws(const std::filesystem::path& directory);

}  // namespace signorini::directory_check
