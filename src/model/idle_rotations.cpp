#include "model/idle_rotations.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "base/listed.hpp"

namespace signorini {
namespace {

constexpr std::size_t rotation = 2, most_listed = 3;

/// Rotations of nodes that elements connect to.
class Turning {
 public:
  explicit Turning(const DofMap& map) : map_(map), nodes_(map.mesh.nodes.size()) {
    for (const auto& e : map.mesh.elements) {
      for (const int node : e->nodes()) {
        at(node).carried = true;
        at(node).plane = at(node).plane || e->nodes().size() > 2;
      }
      for (const ElementUnknown& unknown : e->unknowns())
        if (!unknown.own && unknown.component == rotation) at(e->nodes()[unknown.place]).turns = true;
    }
  }
  /// True if elements end at the node but none of them, and no rigid body, rotates with it.
  [[nodiscard]] bool idle(const std::string& node) const {
    const int n = map_.mesh.by_name.at(node);
    const Node& here = nodes_[static_cast<std::size_t>(n)];
    return here.carried && !here.turns && map_.body[static_cast<std::size_t>(n)] == DofMap::absent;
  }
  [[nodiscard]] bool of_plane_elements(const std::string& node) const {
    return nodes_[static_cast<std::size_t>(map_.mesh.by_name.at(node))].plane;
  }

 private:
  struct Node {
    bool carried = false, turns = false, plane = false;
  };
  Node& at(int node) { return nodes_[static_cast<std::size_t>(node)]; }

  const DofMap& map_;
  std::vector<Node> nodes_;
};

/// Table keys and the nodes that they name, in the order of the scene.
using Named = std::vector<std::pair<std::string, std::vector<std::string>>>;

void name(Named& list, const std::string& key, const std::string& node) {
  if (list.empty() || list.back().first != key) list.push_back({key, {}});
  if (list.back().second.empty() || list.back().second.back() != node) list.back().second.push_back(node);
}

std::string nodes_of(const std::vector<std::string>& nodes) {
  return (nodes.size() == 1 ? "node " : "nodes ") + listed(nodes, most_listed);
}

}  // namespace

std::vector<std::string> idle_rotations(const Scene& scene, const DofMap& map) {
  if (map.matrices()) return {};
  const Turning turning(map);
  Named moved, held;
  for (const PointMass& mass : scene.masses)
    if (mass.inertia > 0.0 && turning.idle(mass.node)) name(moved, "inertia", mass.node);
  for (const Spring& spring : scene.springs) {
    if (spring.rotation_stiffness == 0.0 && spring.rotation_damping == 0.0) continue;
    for (const std::string& node : {spring.node, spring.against})
      if (!node.empty() && turning.idle(node)) name(moved, "a spring of rotations", node);
  }
  for (const Support& support : scene.supports)
    if (support.rz && turning.idle(support.node) && turning.of_plane_elements(support.node))
      name(held, support.key, support.node);
  std::vector<std::string> said;
  for (const auto& [what, nodes] : moved)
    said.push_back(fmt::format("{} at {}: no element turns with {}, so nothing else feels it", what,
                               nodes_of(nodes), nodes.size() == 1 ? "it" : "them"));
  for (const auto& [key, nodes] : held)
    said.push_back(
        fmt::format("{}.fix: rz at {} holds nothing, since elements of bodies have no rotations; to clamp a "
                    "body hold ux and uy of several nodes",
                    key, nodes_of(nodes)));
  return said;
}

}  // namespace signorini
