// scene_text.hpp: the text of a scene file, before it is parsed.
#pragma once

#include <string>

namespace signorini {

/// The whole file; parse_scene() makes a scene of it. Errors: FileError; SceneError where it is larger than 64 MB.
[[nodiscard]] std::string scene_text(const std::string& path);

}  // namespace signorini
