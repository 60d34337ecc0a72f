// unit_words.hpp: units of tables in a scene's words.
//
//   "force/length", { force = "kN", length = "m" }   ->   "kN/m"        a product, "*", is a blank
#pragma once

#include <string>
#include <string_view>

#include "signorini/scene.hpp"

namespace signorini {

/// `unit` has letters in names of quantities only; words that are none of the four stay.
[[nodiscard]] std::string unit_in_words(std::string_view unit, const Units& units);

}  // namespace signorini
