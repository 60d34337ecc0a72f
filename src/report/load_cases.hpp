// load_cases.hpp: tables of loads and responses from summary.json, for one run or for several runs side by side.
//
//   contacts[].static_reaction, .load    N at rest; least and largest N and T with their times;
//                                        residual slip; friction loss
//   response[]                           least and largest value with time, and the place of an
//                                        envelope; final value
//
// Signs are those of the summary: N < 0 is compression, so the least N is the largest compression. Rounding errors,
// compared with the largest value of the same unit in the run, are shown as 0.
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

/// HTML table of one run, with the sign conventions; empty if the run has no contacts. A click on a time, <td data-t=...>,
/// moves the player of the page to this time.
[[nodiscard]] std::string support_loads_html(const base::Json& summary);
/// HTML table of outputs; envelopes: only outputs of kind envelope, otherwise only outputs of all other kinds.
[[nodiscard]] std::string responses_html(const base::Json& summary, bool envelopes);

/// Reads the summaries of run directories; a case has the name of its directory without the path. Errors: FileError, also
/// if a directory is no run, if two cases have the same name, or if units differ.
[[nodiscard]] std::vector<LoadCase> read_load_cases(const std::vector<std::filesystem::path>& directories);

/// Warnings about cases that did not reach their end, and about cases with different contacts.
[[nodiscard]] std::vector<std::string> load_case_warnings(const std::vector<LoadCase>& cases);

/// CSV table item,quantity,unit,CASE,CASE t,...,governing with one row per figure; a cell is empty if the case has no
/// such figure.
[[nodiscard]] std::string load_cases_csv(const std::vector<LoadCase>& cases);
/// Sections of the page: cases, support loads, responses, member envelopes.
[[nodiscard]] std::string load_cases_html(const std::vector<LoadCase>& cases);

}  // namespace signorini::report
