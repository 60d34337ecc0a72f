// frontier.hpp: which engine is cheapest for which accuracy.
//
//   A run is on the frontier if no other one is as accurate in as much time, give or take a tenth of each.
//   Only runs that reach the end with the reference's sequence of events take part: an error up to where
//   events were lost says little.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "study/speed/work_row.hpp"

namespace signorini {

/// Between which errors runs can be told apart.
struct ErrorRange {
  double floor = 0.0;                                     ///< what the reference itself is known to
  double most = std::numeric_limits<double>::infinity();  ///< beyond, an error means nothing
};

/// Errors fall, times grow from entry to entry. Indices into `rows`.
[[nodiscard]] std::vector<std::size_t> frontier(const std::vector<WorkRow>& rows, const std::string& quantity,
                                                const ErrorRange& range = {});

/// One sentence: "For errors of event time down to 3e-05 s newmark is cheapest (dt=1e-04: 0.02 s), ..."; also
/// where no run is complete, or none was timed.
[[nodiscard]] std::string frontier_sentence(const std::vector<WorkRow>& rows, const std::string& quantity,
                                            const ErrorRange& range = {});

}  // namespace signorini
