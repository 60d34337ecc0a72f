// motion_names.hpp: describes a motion in words.
//
//   u = a                    "horizontal motion", "vertical motion", "motion along (0.8, 0.6)"
//   u = a + theta x (r - c)  "rotation about (12, 6)"
//
// The text adds "of node 'A'" if only one node moves; other motions are named by their largest degree of freedom.
#pragma once

#include <string>

#include "model/assembly/dofs.hpp"

namespace signorini {

/// motion: length n. Entries below 1e-3 of the largest count as at rest.
[[nodiscard]] std::string describe_motion(const Vector& motion, const DofMap& map);

/// True if all nodes move as one rigid body.
[[nodiscard]] bool is_rigid(const Vector& motion, const DofMap& map);

/// Largest displacement of a node (matrix scenes: the largest component).
[[nodiscard]] double greatest_translation(const Vector& motion, const DofMap& map);

}  // namespace signorini
