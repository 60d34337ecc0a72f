// parameter.hpp: reads and sets a key of a scene as a number that can be varied.
//
//   value = the number at PATH in the scene with all defaults filled in;   scene(x) = read(PATH=x)
//
// Tables of an array are selected as in `--set`: by name, by number from 1, or by * for all, whose values must be equal.
#pragma once

#include "signorini/sensitivity.hpp"

namespace signorini::sensitivity {

/// The number at a path of the scene. Errors: UsageError if there is no number, or if the path matches several different
/// numbers.
[[nodiscard]] double value_of(const Scene& scene, const std::string& path);

/// Typical magnitude, in the model, of quantities with the unit of the key; used for steps of a key whose value is zero.
[[nodiscard]] double typical_size(const SceneReader& read, const Scene& scene, const Model& model,
                                  const std::string& path);

/// The override that sets the key to x.
[[nodiscard]] Override set_to(const std::string& path, double x);

}  // namespace signorini::sensitivity
