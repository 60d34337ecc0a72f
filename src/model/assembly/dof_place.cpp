#include "model/assembly/dof_place.hpp"

#include <algorithm>

namespace signorini {

SourcePlace place_of_structure(const Scene& scene) {
  if (scene.matrices) return scene.matrices->mass.place;
  if (!scene.members.empty()) return scene.members.front().place;
  return scene.nodes.empty() ? SourcePlace{scene.file, 1, 1} : scene.nodes.front().place;
}

SourcePlace place_of_dof(const Scene& scene, const DofMap& map, int dof) {
  if (map.matrices()) return scene.matrices->stiffness.place;
  const int node = map.where[static_cast<std::size_t>(dof)].first;
  const bool hinged = std::any_of(map.hinge.begin(), map.hinge.end(), [&](const std::array<int, 2>& ends) {
    return ends[0] == dof || ends[1] == dof;
  });
  if (node < map.mesh.named && !hinged) {
    const std::string& name = map.mesh.nodes[static_cast<std::size_t>(node)].name;
    const auto at = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                 [&](const Node& candidate) { return candidate.name == name; });
    return at == scene.nodes.end() ? place_of_structure(scene) : at->place;
  }
  for (std::size_t e = 0; e < map.mesh.elements.size(); ++e) {
    const MeshElement& element = map.mesh.elements[e];
    const bool its_hinge = hinged && (map.hinge[e][0] == dof || map.hinge[e][1] == dof);
    if (its_hinge || (!hinged && (element.a == node || element.b == node)))
      return scene.members[static_cast<std::size_t>(element.member)].place;
  }
  return place_of_structure(scene);
}

}  // namespace signorini
