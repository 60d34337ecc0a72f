// spread.hpp: what standard deviations of keys make of event times and figures, to first order.
//
//   sigma_x = sqrt( sum_p (dx/dp sigma_p)^2 )       keys that are independent of each other
//
// It holds while the sequence of events does: `reach` is the least change of a key at which two neighbours
// meet, over its sigma. Below 2 one run in twenty has another sequence, and the figure is no more than a
// hint.
#pragma once

#include "signorini/sensitivity.hpp"

namespace signorini {

/// One a parameter; 0: it is known.
using Sigmas = std::vector<double>;

struct Spread {
  std::vector<double> events, responses;  ///< sigma of each time, of each figure; NaN: not known
  std::vector<double> reach;              ///< one a parameter; infinity: nothing meets, or sigma is 0
};
[[nodiscard]] Spread spread(const Sensitivities& s, const Sigmas& sigmas);

}  // namespace signorini
