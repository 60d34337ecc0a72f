// branch_files.hpp: files of `orbit --over`.
//
//   branch.csv    one row per point of the branch, written as soon as the point is found (docs/command-line.md)
//   branch.json   the key, the reason for the branch's end, its sequences of events by number
//   last/         checkpoint for --resume: a point of the first branch, in the format of `orbit`, and mark.json
//
// last/ is updated while the branch is followed. Each update is written to a temporary folder, which then
// replaces last/. Therefore last/ is complete even after a kill.
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

/// The first `rows` rows of branch.csv. outputs: number of outputs. Errors: FileError, also if there are
/// fewer rows.
[[nodiscard]] std::vector<BranchPoint> read_branch(const std::filesystem::path& directory,
                                                   std::size_t outputs, std::size_t rows);

/// Writes the checkpoint to DIR/last. Errors: FileError.
void write_checkpoint(const std::filesystem::path& directory, const SceneReader& read,
                      const BranchOptions& options, const BranchCheckpoint& mark);
/// Removes the checkpoint of an earlier branch.
void remove_checkpoint(const std::filesystem::path& directory);
/// Reads the checkpoint of a branch that ended early or was killed. Errors: FileError; UsageError if the
/// branch is complete, or if it belongs to another scene or to other options.
[[nodiscard]] BranchCheckpoint read_checkpoint(const std::filesystem::path& directory,
                                               const SceneReader& read, const BranchOptions& options);

/// Text of branch.json.
[[nodiscard]] std::string branch_json(const BranchOptions& options, const Units& units, const Branch& branch);

// Picture of a branch of orbits: a frequency response, or amplitudes over another key.
//
//   plots/branch.gp     one panel per output (least and largest value of the output in a period), the largest
//                       multiplier, the number of the sequence of events; stable parts solid, unstable ones
//                       dashed, special points as symbols
//   plots/branch.csv    the curves: x, stable 1 or 0, sequence, special, multiplier, amplitude, outputs

/// Pictures of the branch. outputs: names with units, in the order of BranchPoint::minima; only the first six
/// have a panel.
[[nodiscard]] result::PictureFiles branch_pictures(const std::string& title, const Units& units,
                                                   const BranchOptions& options,
                                                   const std::vector<std::string>& outputs,
                                                   const Branch& branch,
                                                   const result::PictureStyle& look = {});

/// True for a file that branch_pictures() or its scripts write.
[[nodiscard]] bool is_picture_of_branch(const std::filesystem::path& file);

}  // namespace signorini::orbit_study
