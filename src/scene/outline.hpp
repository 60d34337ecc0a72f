// outline.hpp: how a rigid body is drawn: the convex hull of its nodes, the centre among them.
//
//   for (const auto& [from, to] : outline_of(scene, body)) ...   // a line each; one where all lie on a line
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini {

/// Names of the nodes at both ends of each line, round the body.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> outline_of(const Scene& scene,
                                                                          const RigidBody& body);

}  // namespace signorini
