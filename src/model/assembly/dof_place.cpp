#include "model/assembly/dof_place.hpp"

#include <algorithm>

namespace signorini {

SourcePlace place_of_structure(const Scene& scene) {
  if (scene.matrices) return scene.matrices->mass.place;
  if (!scene.members.empty()) return scene.members.front().place;
  if (!scene.bodies.empty()) return scene.bodies.front().place;
  return scene.nodes.empty() ? SourcePlace{scene.file, 1, 1} : scene.nodes.front().place;
}

SourcePlace place_of_dof(const Scene& scene, const DofMap& map, int dof) {
  if (map.matrices()) return scene.matrices->stiffness.place;
  const int node = map.where[static_cast<std::size_t>(dof)].first;
  const auto member_place = [&](std::size_t element) {
    const auto i = static_cast<std::size_t>(map.mesh.element(element).member());
    return i < scene.members.size() ? scene.members[i].place : scene.bodies[i - scene.members.size()].place;
  };
  for (const auto& [unknown, number] : map.own)
    if (number == dof) return member_place(unknown.first);
  if (node < map.mesh.named) {
    const std::string& name = map.mesh.nodes[static_cast<std::size_t>(node)].name;
    const auto at = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                 [&](const Node& candidate) { return candidate.name == name; });
    return at == scene.nodes.end() ? place_of_structure(scene) : at->place;
  }
  for (std::size_t e = 0; e < map.mesh.elements.size(); ++e) {
    const std::vector<int>& nodes = map.mesh.element(e).nodes();
    if (std::find(nodes.begin(), nodes.end(), node) != nodes.end()) return member_place(e);
  }
  return place_of_structure(scene);
}

}  // namespace signorini
