// decades.hpp: parses settings on a logarithmic scale.
//
//   1e-4:1e-12      1e-4, 1e-5, ..., 1e-12: factor 1/10; the stop is included if it is reached
//   1e-2:1e-3:2     1e-2, 5e-3, 2.5e-3, 1.25e-3: the third number is the factor between neighbours
//   1e-3,4e-4       a list
#pragma once

#include <string>
#include <vector>

namespace signorini {

/// Numbers > 0 in the given order. Errors: UsageError, which begins with `option`, also for more than 100 values.
[[nodiscard]] std::vector<double> parse_decades(const std::string& option, const std::string& text);

/// The value as written by hand: 1e-05, not 1.0000000000000003e-05.
[[nodiscard]] double tidy(double value);

}  // namespace signorini
