// units_json.hpp: the units of a scene, in the words of scene files.
#pragma once

#include "base/json.hpp"

#include "signorini/scene.hpp"

namespace signorini {

/// force, mass, length, time
[[nodiscard]] Json units_json(const Units& units);
/// The same, read back. Errors: Json::exception.
[[nodiscard]] Units units_from(const Json& json);

}  // namespace signorini
