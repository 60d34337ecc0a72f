// element_kinds.hpp: which elements there are: how each type of member becomes elements, and of which lines it is drawn.
#pragma once

#include "model/element/mesh.hpp"

namespace signorini {

struct ElementKind {
  MemberType type;
  /// Appends the nodes and elements of a member, an index into Scene::members. Errors: SceneError.
  void (*mesh)(Mesh& mesh, const Scene& scene, std::size_t member);
  bool bends = false;   ///< its lines are cubics, not straight
  bool closed = false;  ///< a line leads from its last node to its first
};

[[nodiscard]] const ElementKind& kind_of(MemberType type);

/// A line between two named nodes of which a member is drawn, and whether its ends turn without the nodes.
struct MemberLine {
  std::string from, to;
  bool bends = false, hinged_from = false, hinged_to = false;
};
[[nodiscard]] std::vector<MemberLine> lines_of(const Member& member);

}  // namespace signorini
