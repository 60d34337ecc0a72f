// reader_at.hpp: a reader of a scene with one key set to a value.
//
//   reader_at(read, path, x)(changes) = read([path = x, changes...])
//   branch_reader: the same; for a branch over the energy of conservative motions no key is changed
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

/// Path that stands for the energy of conservative motions instead of a key.
inline constexpr const char* over_energy = "energy";

[[nodiscard]] inline SceneReader branch_reader(SceneReader read, const std::string& path, double value) {
  return path == over_energy ? std::move(read) : reader_at(std::move(read), path, value);
}

}  // namespace signorini
