// branch_files.hpp: files of `orbit --over`.
//
//   branch.csv    one row per point of the branch, written as it is found (docs/command-line.md)
//   branch.json   the key, the reason for the branch's end, its sequences of events by number
//   last/         a point of the first branch, in the format of `orbit`, and mark.json: --resume continues from there
//
// last/ is written while the branch is followed, through a temporary neighbour that replaces it: after a kill it is
// complete.
#pragma once

#include <filesystem>
#include <vector>

#include "result/csv.hpp"
#include "signorini/orbit.hpp"

namespace signorini {

class BranchWriter {
 public:
  /// outputs: names of the outputs. Errors of all members: FileError.
  BranchWriter(const std::filesystem::path& directory, const std::vector<std::string>& outputs);
  void add(const BranchPoint& point);

 private:
  CsvBlock block_;
  CsvFile file_;
};

/// The first rows of branch.csv. Errors: FileError, also if there are fewer.
[[nodiscard]] std::vector<BranchPoint> read_branch(const std::filesystem::path& directory,
                                                   std::size_t outputs, std::size_t rows);

/// DIR/last. Errors: FileError.
void write_mark(const std::filesystem::path& directory, const SceneReader& read, const BranchOptions& options,
                const BranchMark& mark);
/// Removes the mark of an earlier branch.
void remove_mark(const std::filesystem::path& directory);
/// The mark of a branch that ended early, or was killed. Errors: FileError; UsageError if the branch is complete, or a
/// different one.
[[nodiscard]] BranchMark read_mark(const std::filesystem::path& directory, const SceneReader& read,
                                   const BranchOptions& options);

[[nodiscard]] std::string branch_json(const BranchOptions& options, const Units& units, const Branch& branch);

}  // namespace signorini
