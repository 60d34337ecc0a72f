// reader_at.hpp: a scene with one key at a value, as a reader of scenes.
//
//   reader_at(read, path, x)(changes) = read([path = x, changes...])
//   branch_reader: the same; a branch over the energy of conservative motions changes no key
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

/// Stands in place of a key: what is stored by conservative motions.
inline constexpr const char* over_energy = "energy";

[[nodiscard]] inline SceneReader branch_reader(SceneReader read, const std::string& path, double value) {
  return path == over_energy ? std::move(read) : reader_at(std::move(read), path, value);
}

}  // namespace signorini
