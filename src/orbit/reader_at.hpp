// reader_at.hpp: a scene with one key at a value, as a reader of scenes.
//
//   reader_at(read, path, x)(changes) = read([path = x, changes...])
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/number.hpp"
#include "signorini/sensitivity.hpp"

namespace signorini {

/// value: in the unit of the key. Errors: those of `read`.
[[nodiscard]] inline SceneReader reader_at(SceneReader read, std::string path, double value) {
  return [read = std::move(read), path = std::move(path), value](const std::vector<Override>& changes) {
    std::vector<Override> all{{path, shortest(value)}};
    all.insert(all.end(), changes.begin(), changes.end());
    return read(all);
  };
}

}  // namespace signorini
