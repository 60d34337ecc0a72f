// outlines.hpp: the drawn outline of a rigid body: the convex hull of its nodes, the centre included.
//
//   for (const auto& [from, to] : outline_of(scene, body)) ...   // each line; a single one if all nodes are collinear
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini::scene {

// Lines for drawings of bodies: edges of their elements, each once; for a large mesh only its boundary.

/// Meshes with more edges are drawn without their inner edges.
inline constexpr std::size_t max_mesh_edges = 6000;

/// Pairs of nodes, indices into Scene::nodes; an edge with a node in its middle is two.
[[nodiscard]] std::vector<std::array<int, 2>> mesh_lines(const Scene& scene);
/// Nodes of these lines, ascending.
[[nodiscard]] std::vector<int> drawn_mesh_nodes(const Scene& scene);

/// Names of the nodes at both ends of each line, in order around the body.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> outline_of(const Scene& scene,
                                                                          const RigidBody& body);

}  // namespace signorini::scene
