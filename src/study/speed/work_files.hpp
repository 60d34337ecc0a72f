// work_files.hpp: files and diagrams of a study (docs/command-line.md).
//
//   study.csv    one row per run: engine, setting, outcome, errors, times, counters
//   study.json   the same data, with machine, versions, notes and Pareto fronts
//   study.md     the table and the sentences, for reading
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/speed/work_study.hpp"

namespace signorini::speed {

/// Table of study.md, with cells as text.
struct WorkTable {
  std::vector<std::string> header;
  std::vector<bool> right;  ///< true for columns of numbers
  std::vector<std::vector<std::string>> rows;
};
[[nodiscard]] WorkTable work_table(const WorkReport& report);

/// One sentence for each Pareto front of the study.
[[nodiscard]] std::vector<std::string> work_conclusions(const WorkReport& report);
/// One sentence for each run that was refused, ended early, or has other events than the reference.
[[nodiscard]] std::vector<std::string> work_failures(const WorkReport& report);

/// Reference of the study: "errors against exact", and the time up to which runs are compared.
[[nodiscard]] std::string work_reference(const WorkReport& report);

/// Conditions of the study: "51 dofs, 2 contacts; AMD ..., 2 cores; ..."
[[nodiscard]] std::string work_conditions(const WorkReport& report);

/// Text of study.json.
[[nodiscard]] std::string work_json(const WorkReport& report);

/// Writes study.csv, study.json and study.md; study.md shows the picture if it exists. Errors: FileError.
void write_work(const std::filesystem::path& directory, const WorkReport& report);

// Work-precision diagrams: time over error, both logarithmic, one line per engine.
//
//   DIR/plots/work-precision.gp, line-1.csv, line-2.csv, ...
//
// Filled points belong to runs that reached the end with the reference's events; lines connect them. Hollow
// points belong to other runs, whose error covers the time up to the first difference of the sequences.

/// Writes the diagrams' scripts and returns their paths; empty if no run has both an error and a time.
/// Errors: FileError.
[[nodiscard]] std::vector<std::filesystem::path> write_work_plots(const std::filesystem::path& directory,
                                                                  const WorkReport& report);

/// Removes the files of write_work_plots() and of its scripts. Errors: FileError.
void remove_work_plots(const std::filesystem::path& directory);

}  // namespace signorini::speed
