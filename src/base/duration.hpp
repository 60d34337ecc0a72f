// duration.hpp: a duration as text.
//
//   duration_text(0.4) == "1 s", (75) == "1.3 min", (5400) == "1.5 h"
#pragma once

#include <string>

namespace signorini {

/// seconds >= 0; two digits from a minute on, whole seconds below.
[[nodiscard]] std::string duration_text(double seconds);

}  // namespace signorini
