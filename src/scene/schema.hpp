// schema.hpp: the key table as a JSON Schema, for editors that complete and check scenes as they are written.
//
//   table T        { "type": "object", "properties": its keys, "additionalProperties": false or T.* }
//   required keys  "required";   defaults "default";   meaning and unit "description"
//
// Draft 7, which TOML servers of editors support. Not included: dependencies between keys (a slider needs a
// normal_force), names of nodes, and files; `signorini check` reads the whole scene.
#pragma once

#include <string>

namespace signorini::scene {

[[nodiscard]] std::string scene_schema();

}  // namespace signorini::scene
