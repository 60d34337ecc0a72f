// body_of_node.hpp: which body a node belongs to.
#pragma once

#include <optional>

#include "signorini/scene.hpp"

namespace signorini {

/// node: index into Scene::nodes; returns an index into Scene::bodies.
[[nodiscard]] inline std::optional<std::size_t> body_of_node(const Scene& scene, std::size_t node) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const BodySpec& body = scene.bodies[i];
    if (node >= body.first_node && node < body.first_node + body.node_count) return i;
  }
  return std::nullopt;
}

}  // namespace signorini
