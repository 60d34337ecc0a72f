// outlines.hpp: lines for drawings of bodies.
//
//   rigid body   the convex hull of its nodes, the centre included; a single line if all nodes are collinear
//   mesh         edges of its elements, each once; of a large mesh only the boundary
//
//   for (const auto& [from, to] : outline_of(scene, body)) ...
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini::scene {

/// Meshes with more edges are drawn without their inner edges.
inline constexpr std::size_t max_mesh_edges = 6000;

/// Lines of all meshes as pairs of indices into Scene::nodes; an edge with a middle node is two lines.
[[nodiscard]] std::vector<std::array<int, 2>> mesh_lines(const Scene& scene);
/// Nodes at the ends of mesh_lines(): ascending indices into Scene::nodes, each once.
[[nodiscard]] std::vector<int> drawn_mesh_nodes(const Scene& scene);

/// Outline of a rigid body: names of the nodes at both ends of each line, in order around the body.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> outline_of(const Scene& scene,
                                                                          const RigidBody& body);

}  // namespace signorini::scene
