#include "scene/mesh_lines.hpp"

#include <set>

#include "mesh/shared_edges.hpp"

namespace signorini {

std::vector<std::array<int, 2>> mesh_lines(const Scene& scene) {
  SharedEdges edges;
  for (const BodySpec& body : scene.bodies) add_edges(body.mesh.elements, edges);
  std::vector<std::array<int, 2>> lines;
  for (const auto& [ends, edge] : edges) {
    if (edges.size() > most_mesh_edges && edge.elements > 1) continue;
    const bool middle = edge.nodes.size() == 3;
    lines.push_back({edge.nodes[0], edge.nodes[middle ? 2 : 1]});
    if (middle) lines.push_back({edge.nodes[2], edge.nodes[1]});
  }
  return lines;
}

std::vector<int> drawn_mesh_nodes(const Scene& scene) {
  std::set<int> nodes;
  for (const auto& [a, b] : mesh_lines(scene)) nodes.insert({a, b});
  return {nodes.begin(), nodes.end()};
}

}  // namespace signorini
