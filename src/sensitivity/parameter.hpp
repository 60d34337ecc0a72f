// parameter.hpp: a key of a scene as a number that can be varied.
//
//   value = the number at PATH in the scene with all defaults filled in;   scene(x) = read(PATH=x)
//
// Tables of an array are chosen as `--set` does: by name, by number from 1, or all by *, which must agree.
#pragma once

#include "signorini/sensitivity.hpp"

namespace signorini {

/// Errors: UsageError where the path leads to no number, or to several that differ.
[[nodiscard]] double value_of(const Scene& scene, const std::string& path);

/// A size for steps of a key that is zero: what quantities of its unit typically are in the model.
[[nodiscard]] double typical_size(const SceneReader& read, const Scene& scene, const Model& model,
                                  const std::string& path);

/// The change that sets the key to x.
[[nodiscard]] Override set_to(const std::string& path, double x);

}  // namespace signorini
