// comparison_files.hpp: tables of a comparison of several runs (docs/command-line.md).
//
//   runs.csv         one row per run: outcome, events, cost, audit
//   differences.csv  run,quantity,unit,value,t,where,value_until_split,t_until_split,where_until_split
//   columns.csv      run,column,value,t,value_until_split,t_until_split
//   events.csv       run,t_reference,t,difference,contact,event,from,to,swapped   one row per aligned pair
//   compare.json     all of it except the rows of events.csv
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/compare/limits.hpp"

namespace signorini {

struct ComparisonReport {
  std::vector<ComparedRun> runs;        ///< readable runs; the first is the reference
  std::vector<Comparison> comparisons;  ///< runs[1], runs[2], ... compared with the reference
  std::vector<Limit> limits;
  std::vector<std::string> exceeded;  ///< limits.hpp
  /// Engines that refused the scene: name and reason.
  std::vector<std::pair<std::string, std::string>> refused;
};

/// "exact has no more events; ida has first slip, stick -> slip+ at t = 0.31"
[[nodiscard]] std::string split_text(const ComparedRun& reference, const ComparedRun& other,
                                     const Alignment::Split& split);

[[nodiscard]] std::string comparison_json(const ComparisonReport& report);

/// Errors: FileError.
void write_comparison(const std::filesystem::path& directory, const ComparisonReport& report);

}  // namespace signorini
