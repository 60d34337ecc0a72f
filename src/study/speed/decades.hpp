// decades.hpp: settings on a logarithmic scale.
//
//   1e-4:1e-12      1e-4, 1e-5, ..., 1e-12: each a tenth of the one before, the stop included where it is hit
//   1e-2:1e-3:2     1e-2, 5e-3, 2.5e-3, 1.25e-3: the third number is the factor between neighbours
//   1e-3,4e-4       a list
#pragma once

#include <string>
#include <vector>

namespace signorini {

/// Numbers > 0 in the order given. Errors: UsageError, which begins with `option`, also for more than 100.
[[nodiscard]] std::vector<double> parse_decades(const std::string& option, const std::string& text);

/// As it would be written by hand: 1e-05, not 1.0000000000000003e-05.
[[nodiscard]] double tidy(double value);

}  // namespace signorini
