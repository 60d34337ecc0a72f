// units_json.hpp: the units of a scene, in the words of scene files.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "signorini/scene.hpp"

namespace signorini {

/// force, mass, length, time
[[nodiscard]] nlohmann::ordered_json units_json(const Units& units);
/// The same, read back. Errors: nlohmann::json::exception.
[[nodiscard]] Units units_from(const nlohmann::ordered_json& json);

}  // namespace signorini
