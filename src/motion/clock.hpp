// clock.hpp: how sharply a double tells the time.
#pragma once

#include <cmath>
#include <limits>

namespace signorini {

/// Times that are the same to an integrator's clock: IDA's own measure.
[[nodiscard]] inline double resolution_at(double t, double step) {
  return 100.0 * std::numeric_limits<double>::epsilon() * (std::abs(t) + std::abs(step));
}

}  // namespace signorini
