// line_member.hpp: a member of bars or beams: a chain of pieces, each with elements of equal length.
#pragma once

#include "model/element/mesh.hpp"

namespace signorini {

/// Appends the inner nodes, pieces and elements of a member. Errors: SceneError.
void mesh_line_member(Mesh& mesh, const Scene& scene, std::size_t number);

/// True if the member's end at this node, an index into Member::nodes, is hinged; false for inner nodes.
[[nodiscard]] bool is_hinged(const Member& member, std::size_t node);

/// The section of a member of the mesh.
[[nodiscard]] const Section& section_of(const Scene& scene, const Member& member);

}  // namespace signorini
