// load_cases.hpp: what a run's summary.json says about loads, as figures; of one run as tables, of several side by side.
//
//   contacts[].static_reaction, .load    N at rest; least and greatest N and T with their times; residual slip; friction loss
//   response[]                           least and greatest value with time, and the place of an envelope; value at the end
//
// Signs are those of the summary: N < 0 is compression, so that least N is the greatest compression. A number that is rounding beside
// the greatest of its kind in its run is shown as 0.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/json.hpp"

namespace signorini {

/// A run of several, and what it is called beside the others.
struct LoadCase {
  std::string name;
  Json summary;
};

/// "<table>..." of one run, and its signs; empty where it has none. Times are buttons for the page's player: <td data-t=...>.
[[nodiscard]] std::string support_loads_html(const Json& summary);
/// Outputs that are no envelope, and those that are.
[[nodiscard]] std::string responses_html(const Json& summary, bool envelopes);

/// Summaries of run directories, named by the directory's last part. Errors: FileError, also where one is no run, two have the same
/// name, or units differ.
[[nodiscard]] std::vector<LoadCase> read_load_cases(const std::vector<std::filesystem::path>& directories);

/// Sentences: cases that did not reach their end, and cases of different structures.
[[nodiscard]] std::vector<std::string> load_case_doubts(const std::vector<LoadCase>& cases);

/// item,quantity,unit,CASE,CASE t,...,governing: a row a figure; a cell is empty where the case has no such item.
[[nodiscard]] std::string load_cases_csv(const std::vector<LoadCase>& cases);
/// Sections: cases, support loads, responses, member envelopes.
[[nodiscard]] std::string load_cases_html(const std::vector<LoadCase>& cases);

}  // namespace signorini
