// motion_names.hpp: describes motions of a structure in words.
//
//   u = a                    "horizontal motion", "vertical motion", "motion along (0.8, 0.6)"
//   u = a + theta x (r - c)  "rotation about (12, 6)"
//
// The text adds "of node 'A'" if only one node moves; other motions are named by their largest degree of freedom.
#pragma once

#include <string>
#include <vector>

#include "model/assembly/dofs.hpp"

namespace signorini::assembly {

/// motion: length n. Entries below 1e-3 of the largest are treated as zero.
[[nodiscard]] std::string describe_motion(const Vector& motion, const DofMap& map);
/// The same for a part of the structure, its degrees of freedom `dofs`: "vertical motion of the part with node 'A'".
[[nodiscard]] std::string describe_motion_of_part(const Vector& motion, const DofMap& map,
                                                  const std::vector<int>& dofs);

/// True if all nodes move as one rigid body.
[[nodiscard]] bool is_rigid(const Vector& motion, const DofMap& map);
/// True if all nodes that the degrees of freedom `dofs` move, a part of the structure, move as one rigid body.
[[nodiscard]] bool is_rigid(const Vector& motion, const DofMap& map, const std::vector<int>& dofs);

/// Largest displacement of a node (matrix scenes: the largest component).
[[nodiscard]] double max_translation(const Vector& motion, const DofMap& map);

}  // namespace signorini::assembly
