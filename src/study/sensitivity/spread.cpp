#include "study/sensitivity/spread.hpp"

#include <cmath>

namespace signorini {
namespace {

template <class RateOf>
double sigma_of(const Sigmas& sigmas, const RateOf& rate) {
  double sum = 0.0;
  for (std::size_t p = 0; p < sigmas.size(); ++p)
    if (sigmas[p] > 0.0) sum += rate(p) * sigmas[p] * rate(p) * sigmas[p];
  return std::sqrt(sum);
}

}  // namespace

Spread spread(const Sensitivities& s, const Sigmas& sigmas) {
  Spread result;
  for (const auto& rates : s.event_rates)
    result.events.push_back(sigma_of(sigmas, [&](std::size_t p) { return rates[p].t; }));
  for (const Response& r : s.responses)
    result.responses.push_back(sigma_of(sigmas, [&](std::size_t p) { return r.rates[p]; }));
  result.reach.assign(sigmas.size(), std::numeric_limits<double>::infinity());
  for (const Swap& swap : least_swaps(s))
    if (sigmas[swap.parameter] > 0.0)
      result.reach[swap.parameter] =
          std::min(result.reach[swap.parameter], std::abs(swap.change) / sigmas[swap.parameter]);
  return result;
}

}  // namespace signorini
