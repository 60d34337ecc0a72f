// dof_place.hpp: place in the scene file from which a degree of freedom comes.
//
//   a named node       its line in [nodes]
//   an inner node      the member that it stands on, as does the rotation of a hinged end
//   matrices           the stiffness
#pragma once

#include "model/assembly/dofs.hpp"

namespace signorini {

[[nodiscard]] SourcePlace place_of_dof(const Scene& scene, const DofMap& map, int dof);
/// Place of the structure as a whole: its first member or node, or its mass matrix.
[[nodiscard]] SourcePlace place_of_structure(const Scene& scene);

}  // namespace signorini
