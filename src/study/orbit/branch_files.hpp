// branch_files.hpp: what `orbit --over` writes.
//
//   branch.csv    a row a point of the branch, as it comes (docs/command-line.md)
//   branch.json   the key, why the branch ends, its sequences of events by number
#pragma once

#include <filesystem>

#include "result/csv.hpp"
#include "signorini/orbit.hpp"

namespace signorini {

class BranchWriter {
 public:
  /// outputs: names. Errors of all members: FileError.
  BranchWriter(const std::filesystem::path& directory, const std::vector<std::string>& outputs);
  void add(const BranchPoint& point);

 private:
  CsvBlock block_;
  CsvFile file_;
};

[[nodiscard]] std::string branch_json(const BranchOptions& options, const Units& units, const Branch& branch);

}  // namespace signorini
