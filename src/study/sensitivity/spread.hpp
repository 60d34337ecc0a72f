// spread.hpp: standard deviations of event times and figures from those of keys, to first order.
//
//   sigma_x = sqrt( sum_p (dx/dp sigma_p)^2 )       for independent keys
//
// The result is valid while the sequence of events does not change: `reach` is the smallest change of a key at which
// two neighbouring events meet, divided by its sigma. Below 2, one run in twenty has another sequence, and the result
// is only indicative.
#pragma once

#include "signorini/sensitivity.hpp"

namespace signorini {

/// One per parameter; 0: the parameter is known exactly.
using Sigmas = std::vector<double>;

struct Spread {
  std::vector<double> events, responses;  ///< sigma of each time, of each figure; NaN: unknown
  std::vector<double> reach;              ///< one per parameter; infinity: no events meet, or sigma is 0
};
[[nodiscard]] Spread spread(const Sensitivities& s, const Sigmas& sigmas);

}  // namespace signorini
