// key_reference.hpp: the key table as text: for a terminal, and as docs/scene.md.
//
// Keys, types, units, defaults and meanings come from scene/keys.hpp; the words around them are texts/scene.md, in which
// a line "@keys TABLE@" stands for the keys of that table. Tables that it does not name come at its end.
#pragma once

#include <string>
#include <vector>

namespace signorini::cli {

/// One line a key: path, type, unit, default, meaning. Only lines that have all of the words, whatever the case.
/// Errors: UsageError where no line has.
[[nodiscard]] std::string key_list(const std::vector<std::string>& words = {});

/// docs/scene.md, whole.
[[nodiscard]] std::string scene_reference();

}  // namespace signorini::cli
