#include "model/element/mesh.hpp"

#include <fmt/core.h>

#include "model/element/body_mesh.hpp"
#include "model/element/element_kinds.hpp"

namespace signorini::element {

int find_node(const Mesh& mesh, const std::string& name, const SourcePlace& place, const std::string& key) {
  if (const auto found = mesh.by_name.find(name); found != mesh.by_name.end()) return found->second;
  throw SceneError(place, key, fmt::format("no node is named '{}'", name));
}

Mesh make_mesh(const Scene& scene) {
  Mesh mesh;
  for (const Node& node : scene.nodes) {
    mesh.by_name.emplace(node.name, static_cast<int>(mesh.nodes.size()));
    mesh.nodes.push_back({node.name, node.x, node.y, !node.is_mesh_node});
  }
  mesh.named = static_cast<int>(mesh.nodes.size());
  for (std::size_t i = 0; i < scene.members.size(); ++i)
    kind_of(scene.members[i].type).generate(mesh, scene, i);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) mesh_body(mesh, scene, i);
  return mesh;
}

}  // namespace signorini::element
