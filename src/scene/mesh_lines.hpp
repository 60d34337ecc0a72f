// mesh_lines.hpp: how bodies are drawn: edges of their elements, each once; of a large mesh its boundary alone.
#pragma once

#include <array>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini {

/// Edges, from which on inner ones are not drawn.
inline constexpr std::size_t most_mesh_edges = 6000;

/// Pairs of nodes, indices into Scene::nodes; an edge with a node in its middle is two.
[[nodiscard]] std::vector<std::array<int, 2>> mesh_lines(const Scene& scene);
/// Their nodes, ascending.
[[nodiscard]] std::vector<int> drawn_mesh_nodes(const Scene& scene);

}  // namespace signorini
