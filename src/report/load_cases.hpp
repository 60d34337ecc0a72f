// load_cases.hpp: loads from summary.json as figures: tables for one run, or several runs side by side.
//
//   contacts[].static_reaction, .load    N at rest; least and largest N and T with their times;
//                                        residual slip; friction loss
//   response[]                           least and largest value with time, and the place of an
//                                        envelope; final value
//
// Signs are those of the summary: N < 0 is compression, so the least N is the largest compression. A number of rounding
// size relative to the largest of its kind in its run is shown as 0.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/json.hpp"

namespace signorini::report {

/// One of several runs, with its name in the comparison.
struct LoadCase {
  std::string name;
  base::Json summary;
};

/// "<table>..." of one run, with the sign conventions; empty if it has no contacts. Times are buttons of the page's
/// player: <td data-t=...>.
[[nodiscard]] std::string support_loads_html(const base::Json& summary);
/// Table of the outputs without envelopes, or of the envelopes.
[[nodiscard]] std::string responses_html(const base::Json& summary, bool envelopes);

/// Summaries of run directories, named by the directory's last part. Errors: FileError, also if a directory is no run,
/// if two have the same name, or if units differ.
[[nodiscard]] std::vector<LoadCase> read_load_cases(const std::vector<std::filesystem::path>& directories);

/// Warnings: cases that did not reach their end, and cases with different structures.
[[nodiscard]] std::vector<std::string> load_case_warnings(const std::vector<LoadCase>& cases);

/// Table item,quantity,unit,CASE,CASE t,...,governing: one row per figure; a cell is empty if the case has no
/// such item.
[[nodiscard]] std::string load_cases_csv(const std::vector<LoadCase>& cases);
/// Sections of the page: cases, support loads, responses, member envelopes.
[[nodiscard]] std::string load_cases_html(const std::vector<LoadCase>& cases);

}  // namespace signorini::report
