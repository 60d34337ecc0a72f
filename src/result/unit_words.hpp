// unit_words.hpp: units of tables with the unit names of a scene.
//
//   "force/length", { force = "kN", length = "m" }   ->   "kN/m"        a product, "*", becomes a blank
#pragma once

#include <string>
#include <string_view>

#include "signorini/scene.hpp"

namespace signorini {

/// In `unit`, letters only occur in names of quantities; words other than the four are unchanged.
[[nodiscard]] std::string unit_in_words(std::string_view unit, const Units& units);

}  // namespace signorini
