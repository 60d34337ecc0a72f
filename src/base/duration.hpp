// duration.hpp: how long something takes, as a person says it.
//
//   duration_text(0.4) == "1 s", (75) == "1.3 min", (5400) == "1.5 h"
#pragma once

#include <string>

namespace signorini {

/// seconds >= 0; two digits above a minute, whole seconds below.
[[nodiscard]] std::string duration_text(double seconds);

}  // namespace signorini
