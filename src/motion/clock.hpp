// clock.hpp: how sharply a double tells the time.
#pragma once

#include <cmath>

#include "base/rounding.hpp"

namespace signorini {

/// Times that are the same to an integrator's clock: IDA's own measure.
[[nodiscard]] inline double resolution_at(double t, double step) {
  return rounding::of_time * (std::abs(t) + std::abs(step));
}

}  // namespace signorini
