#include "scene/outlines.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_set>

#include "mesh/mesh_quality.hpp"

namespace signorini::scene {

std::vector<std::array<int, 2>> mesh_lines(const Scene& scene) {
  mesh::SharedEdges edges;
  for (const BodySpec& body : scene.bodies) mesh::add_edges(body.mesh.elements, edges);
  std::vector<std::array<int, 2>> lines;
  for (const auto& [ends, edge] : edges) {
    if (edges.size() > max_mesh_edges && edge.elements > 1) continue;
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

namespace {

// Tolerance relative to the product of two lengths; chosen for drawings, where smaller deviations are invisible.
constexpr double on_the_line = 1e-9;

/// True if c is on the left of the line from a to b.
bool turns_left(const Node& a, const Node& b, const Node& c) {
  const double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - a.x, vy = c.y - a.y;
  return ux * vy - uy * vx > on_the_line * std::hypot(ux, uy) * std::hypot(vx, vy);
}

/// Appends one side of the convex hull: of nodes sorted by x the lower side, of nodes in reversed order the upper side.
template <class Iterator>
void add_side(Iterator first, Iterator last, std::vector<Node>& hull) {
  const std::size_t begin = hull.size();
  for (; first != last; ++first) {
    while (hull.size() >= begin + 2 && !turns_left(hull[hull.size() - 2], hull.back(), *first))
      hull.pop_back();
    hull.push_back(*first);
  }
  hull.pop_back();  // the other side of the hull begins with this node
}

}  // namespace

std::vector<std::pair<std::string, std::string>> outline_of(const Scene& scene, const RigidBody& body) {
  std::unordered_set<std::string> names(body.nodes.begin(), body.nodes.end());
  names.insert(body.centre);
  std::vector<Node> nodes, hull;
  for (const Node& node : scene.nodes)
    if (names.contains(node.name)) nodes.push_back(node);
  if (nodes.size() < 2) return {};
  std::sort(nodes.begin(), nodes.end(),
            [](const Node& a, const Node& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  add_side(nodes.begin(), nodes.end(), hull);
  add_side(nodes.rbegin(), nodes.rend(), hull);
  std::vector<std::pair<std::string, std::string>> lines;
  for (std::size_t i = 0; i < (hull.size() == 2 ? 1 : hull.size()); ++i)
    lines.emplace_back(hull[i].name, hull[(i + 1) % hull.size()].name);
  return lines;
}

}  // namespace signorini::scene
