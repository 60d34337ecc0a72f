// scene_equal.hpp: the whole scene but its file, place and resolved text, as one string to compare.
//
//   CHECK(dump(a) == dump(b));
#pragma once

#include <string>

#include "signorini/scene.hpp"

namespace signorini::testing {

[[nodiscard]] std::string dump(const Scene& scene);

}  // namespace signorini::testing
