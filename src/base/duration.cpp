#include "base/duration.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace signorini {

std::string duration_text(double seconds) {
  constexpr double minute = 60.0, hour = 3600.0, day = 86400.0;
  const auto in = [&](double unit, const char* name) {
    const double value = seconds / unit;
    return value < 9.95 ? fmt::format("{:.1f} {}", value, name) : fmt::format("{:.0f} {}", value, name);
  };
  if (seconds < minute - 0.5) return fmt::format("{:.0f} s", std::max(1.0, std::ceil(seconds)));
  if (seconds < hour) return in(minute, "min");
  return seconds < day ? in(hour, "h") : in(day, "days");
}

}  // namespace signorini
