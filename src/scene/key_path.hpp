// key_path.hpp: the key of the scene that a path means, and the values that it may have.
//
//   key_of("contacts.left.normal_stiffness") == find_key("contacts[]", "normal_stiffness")
//   range_of(*key_of("rigid.block.inertia")) == [0, infinity)
#pragma once

#include <limits>
#include <string>

#include "scene/keys.hpp"

namespace signorini {

/// Null where the path is none of a key.
[[nodiscard]] const Key* key_of(const std::string& path);

/// Numbers from `least` to `greatest`; `open`: not the least itself. In the key's unit.
struct KeyRange {
  double least = -std::numeric_limits<double>::infinity();
  double greatest = std::numeric_limits<double>::infinity();
  bool open = false;
  [[nodiscard]] bool has(double value) const {
    return (open ? value > least : value >= least) && value <= greatest;
  }
};

/// By the key's type alone; what other keys ask of it is not in it.
[[nodiscard]] KeyRange range_of(const Key& key);

}  // namespace signorini
