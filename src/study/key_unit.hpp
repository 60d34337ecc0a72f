// key_unit.hpp: the unit of a key of the scene, by its path, with the scene's unit names.
//
//   key_unit("contacts.left.normal_stiffness", units) == "kN/m",   key_unit("contacts.*.friction", units) == ""
#pragma once

#include <string>

#include "signorini/scene.hpp"

namespace signorini {

/// Empty for a plain number, and if the path is not a key.
[[nodiscard]] std::string key_unit(const std::string& path, const Units& units);
/// "PATH [UNIT]", or the path alone.
[[nodiscard]] std::string key_with_unit(const std::string& path, const Units& units);

}  // namespace signorini
