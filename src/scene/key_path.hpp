// key_path.hpp: the key of a scene that a path refers to, and its allowed values.
//
//   key_of("contacts.left.normal_stiffness") == find_key("contacts[]", "normal_stiffness")
//   range_of(*key_of("rigid.block.inertia")) == [0, infinity)
#pragma once

#include <limits>
#include <string>

#include "scene/keys.hpp"

namespace signorini {

/// Null if the path refers to no key.
[[nodiscard]] const Key* key_of(const std::string& path);

/// Numbers from `least` to `greatest`, in the key's unit; `open`: `least` itself is excluded.
struct KeyRange {
  double least = -std::numeric_limits<double>::infinity();
  double greatest = std::numeric_limits<double>::infinity();
  bool open = false;
  [[nodiscard]] bool has(double value) const {
    return (open ? value > least : value >= least) && value <= greatest;
  }
};

/// Range by the key's type alone; restrictions by other keys are not included.
[[nodiscard]] KeyRange range_of(const Key& key);

}  // namespace signorini
