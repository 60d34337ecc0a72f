// mesh_lines.hpp: lines for drawings of bodies: edges of their elements, each once; for a large mesh only its boundary.
#pragma once

#include <array>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini {

/// Meshes with more edges are drawn without their inner edges.
inline constexpr std::size_t most_mesh_edges = 6000;

/// Pairs of nodes, indices into Scene::nodes; an edge with a node in its middle is two.
[[nodiscard]] std::vector<std::array<int, 2>> mesh_lines(const Scene& scene);
/// Nodes of these lines, ascending.
[[nodiscard]] std::vector<int> drawn_mesh_nodes(const Scene& scene);

}  // namespace signorini
