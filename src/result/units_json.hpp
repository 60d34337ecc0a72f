// units_json.hpp: the units of a scene as JSON, with the keys of scene files.
#pragma once

#include "base/json.hpp"

#include "signorini/scene.hpp"

namespace signorini {

/// Object with force, mass, length, time.
[[nodiscard]] Json units_json(const Units& units);
/// The inverse of units_json. Errors: Json::exception.
[[nodiscard]] Units units_from(const Json& json);

}  // namespace signorini
