// work_files.hpp: a study as files (docs/command-line.md).
//
//   study.csv    one row a run: engine, setting, outcome, errors, times, counters
//   study.json   the same, with machine, versions, notes and frontiers
//   study.md     the table and the sentences, to be read
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/speed/work_study.hpp"

namespace signorini {

/// The table for people: cells as text.
struct WorkTable {
  std::vector<std::string> header;
  std::vector<bool> right;  ///< columns of numbers
  std::vector<std::vector<std::string>> rows;
};
[[nodiscard]] WorkTable work_table(const WorkReport& report);

/// What the study found, one sentence each: the frontiers, then how rows fail.
[[nodiscard]] std::vector<std::string> work_conclusions(const WorkReport& report);
[[nodiscard]] std::vector<std::string> work_failures(const WorkReport& report);

/// "errors against exact", and up to where
[[nodiscard]] std::string work_reference(const WorkReport& report);

/// "51 dofs, 2 contacts; AMD ..., 2 cores; ..."
[[nodiscard]] std::string work_circumstances(const WorkReport& report);

[[nodiscard]] std::string work_json(const WorkReport& report);

/// study.md shows the picture if it is there. Errors: FileError.
void write_work(const std::filesystem::path& directory, const WorkReport& report);

}  // namespace signorini
