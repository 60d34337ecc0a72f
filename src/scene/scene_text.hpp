// scene_text.hpp: what a scene file says, before anybody understands it.
#pragma once

#include <string>

namespace signorini {

/// All of the file; parse_scene() makes a scene of it. Errors: FileError; SceneError where it is larger than 64 MB.
[[nodiscard]] std::string scene_text(const std::string& path);

}  // namespace signorini
