// outline.hpp: the drawn outline of a rigid body: the convex hull of its nodes, the centre included.
//
//   for (const auto& [from, to] : outline_of(scene, body)) ...   // each line; a single one if all nodes are collinear
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini {

/// Names of the nodes at both ends of each line, in order around the body.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> outline_of(const Scene& scene,
                                                                          const RigidBody& body);

}  // namespace signorini
