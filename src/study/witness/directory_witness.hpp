// directory_witness.hpp: the witness of a run by its files alone (docs/theory-checks.md, "The witness").
//
//   run.toml -> model;   summary.json -> engine;   instants.csv, events.csv -> src/witness, instant by instant
//   contacts.csv: a row a time and contact, its state that of the last instant, its guards, its forces those of its state
//   summary.json: as many events of each type as events.csv has; peaks no less than rows
//
//   DirectoryTestimony found = witness_directory("pipeline-run");
//
// What the run itself found is not read. Errors: FileError for files that are missing, cut or no tables of a run,
// SceneError for run.toml.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "signorini/result.hpp"

namespace signorini {

/// Violations by their first hundred, in the units of the scene; Violation::event of what tables say is their name.
struct DirectoryTestimony {
  Model model;
  long instants = 0, events = 0, rows = 0;  ///< checked; rows: of contacts.csv and motion.csv
  bool complete = true;                     ///< the run had ended
  Testimony testimony;
};

[[nodiscard]] DirectoryTestimony witness_directory(const std::filesystem::path& directory);

}  // namespace signorini
