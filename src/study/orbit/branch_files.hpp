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
#include "result/picture_files.hpp"
#include "signorini/orbit.hpp"

namespace signorini::orbit_study {

class BranchWriter {
 public:
  /// outputs: names of the outputs. Errors of all members: FileError.
  BranchWriter(const std::filesystem::path& directory, const std::vector<std::string>& outputs);
  void add(const BranchPoint& point);

 private:
  result::CsvBlock block_;
  result::CsvFile file_;
};

/// The first rows of branch.csv. Errors: FileError, also if there are fewer.
[[nodiscard]] std::vector<BranchPoint> read_branch(const std::filesystem::path& directory,
                                                   std::size_t outputs, std::size_t rows);

/// DIR/last. Errors: FileError.
void write_mark(const std::filesystem::path& directory, const SceneReader& read, const BranchOptions& options,
                const BranchCheckpoint& mark);
/// Removes the mark of an earlier branch.
void remove_mark(const std::filesystem::path& directory);
/// The mark of a branch that ended early, or was killed. Errors: FileError; UsageError if the branch is complete, or a
/// different one.
[[nodiscard]] BranchCheckpoint read_mark(const std::filesystem::path& directory, const SceneReader& read,
                                         const BranchOptions& options);

[[nodiscard]] std::string branch_json(const BranchOptions& options, const Units& units, const Branch& branch);

// Picture of a branch of orbits: a frequency response, or amplitudes over another key.
//
//   plots/branch.gp     one panel per output (its least and largest value in a period), the largest multiplier, the
//                       number of the sequence of events; stable parts solid, unstable ones dashed, located points
//                       marked
//   plots/branch.csv    the curves: x, stable 1 or 0, sequence, special, multiplier, amplitude, outputs

/// outputs: names with units, in the order of BranchPoint::minima; at most six panels of them.
[[nodiscard]] result::PictureFiles branch_pictures(const std::string& title, const Units& units,
                                                   const BranchOptions& options,
                                                   const std::vector<std::string>& outputs,
                                                   const Branch& branch,
                                                   const result::PictureStyle& look = {});

[[nodiscard]] bool is_picture_of_branch(const std::filesystem::path& file);

}  // namespace signorini::orbit_study
