// keys.hpp: the key table as text: for a terminal, and as docs/scene.md.
//
// Keys, types, units, defaults and meanings come from scene/keys.hpp. The surrounding text is texts/scene.md; a line
// "@keys TABLE@" in this text is replaced by the keys of TABLE. Tables without such a line are appended.
#pragma once

#include <string>
#include <vector>

namespace signorini::cli {

/// One line per key: path, type, unit, default, meaning. Only lines that contain all words or their synonyms are listed;
/// case is ignored. Errors: UsageError if there is no such line.
[[nodiscard]] std::string key_list(const std::vector<std::string>& words = {});

/// The complete text of docs/scene.md.
[[nodiscard]] std::string scene_reference();

}  // namespace signorini::cli
