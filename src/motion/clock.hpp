// clock.hpp: the resolution of times that are doubles.
#pragma once

#include <cmath>

#include "base/rounding.hpp"

namespace signorini {

/// Times closer than this are equal for an integrator: IDA's own measure.
[[nodiscard]] inline double resolution_at(double t, double step) {
  return rounding::of_time * (std::abs(t) + std::abs(step));
}

}  // namespace signorini
