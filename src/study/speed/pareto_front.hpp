// pareto_front.hpp: the cheapest engine for each accuracy (Pareto front of error and time).
//
// A run is on the front if no other run is as accurate in as little time; differences below a tenth are
// ignored. Only runs that reach the end with the reference's sequence of events are compared, because an
// error up to the first missing event is not comparable.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "study/speed/work_run.hpp"

namespace signorini::speed {

/// Range of errors in which runs can be distinguished.
struct ErrorRange {
  double floor = 0.0;                                     ///< error of the reference itself
  double most = std::numeric_limits<double>::infinity();  ///< larger errors are meaningless
};

/// The front, as indices into `rows`. From entry to entry errors decrease and times increase.
[[nodiscard]] std::vector<std::size_t> pareto_front(const std::vector<WorkRow>& rows,
                                                    const std::string& quantity,
                                                    const ErrorRange& range = {});

/// One sentence: "For errors of event time down to 3e-05 s newmark is cheapest (dt=1e-04: 0.02 s), ...". If
/// no run is complete or timed, the sentence gives this reason.
[[nodiscard]] std::string pareto_sentence(const std::vector<WorkRow>& rows, const std::string& quantity,
                                          const ErrorRange& range = {});

}  // namespace signorini::speed
