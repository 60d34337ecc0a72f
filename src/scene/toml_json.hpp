// toml_json.hpp: a TOML value as a JSON value of the same shape.
#pragma once

#include <toml++/toml.h>

#include "base/json.hpp"

namespace signorini {

/// Dates and times, which no scene has, become empty objects.
[[nodiscard]] Json json_of(const toml::node& node);

}  // namespace signorini
