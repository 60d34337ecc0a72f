// frontier.hpp: which engine is cheapest for which accuracy.
//
//   A run is on the frontier if no other one is as accurate in as much time, give or take a tenth. Only runs
//   that reach the end with the reference's sequence of events take part: an error up to where events were
//   lost says little.
#pragma once

#include <string>
#include <vector>

#include "study/work_row.hpp"

namespace signorini {

/// Errors fall, times grow from entry to entry. Indices into `rows`.
[[nodiscard]] std::vector<std::size_t> frontier(const std::vector<WorkRow>& rows,
                                                const std::string& quantity);

/// One sentence: "Of event times (s), newmark is cheapest down to errors of 3e-05 (dt=1e-04: 0.02 s), ...";
/// also where no run is complete.
[[nodiscard]] std::string frontier_sentence(const std::vector<WorkRow>& rows, const std::string& quantity);

}  // namespace signorini
