// line_member.hpp: a member of bars or beams as elements: a chain of pieces, each with elements of equal parts.
#pragma once

#include "model/element/mesh.hpp"

namespace signorini {

/// Appends the inner nodes, pieces and elements of a member. Errors: SceneError.
void mesh_line_member(Mesh& mesh, const Scene& scene, std::size_t number);

/// Whether the member turns without a node of its own, an index into Member::nodes: at its ends alone.
[[nodiscard]] bool is_hinged(const Member& member, std::size_t node);

/// The section of a member of the mesh.
[[nodiscard]] const Section& section_of(const Scene& scene, const Member& member);

}  // namespace signorini
