// unit_of_text.hpp: parses a unit as a scene writes it.
//
//   "1/m^2", "kN m/s", "s^2/t"     names of the scene's units, each with a power; one '/', all units after it in the
// denominator
//
// The inverse is unit_text() (signorini/output.hpp).
#pragma once

#include <optional>
#include <string_view>

#include "signorini/scene.hpp"

namespace signorini {

/// nullopt: not a unit. mass = force time^2 / length; "1" and "rad" are plain numbers.
[[nodiscard]] std::optional<Unit> unit_of_text(std::string_view text, const Units& names);

}  // namespace signorini
