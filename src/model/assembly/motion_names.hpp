// motion_names.hpp: a motion in an engineer's words.
//
//   u = a                    "horizontal motion", "vertical motion", "motion along (0.8, 0.6)"
//   u = a + theta x (r - c)  "rotation about (12, 6)"
//
// with "of node 'A'" when only one node moves, and the degree of freedom that moves most otherwise.
#pragma once

#include <string>

#include "model/assembly/dofs.hpp"

namespace signorini {

/// motion: n. What moves less than 1e-3 of the greatest counts as at rest.
[[nodiscard]] std::string describe_motion(const Vector& motion, const DofMap& map);

/// Whether all nodes move as one body.
[[nodiscard]] bool is_rigid(const Vector& motion, const DofMap& map);

/// How far the node goes that moves most (matrix scenes: the greatest component).
[[nodiscard]] double greatest_translation(const Vector& motion, const DofMap& map);

}  // namespace signorini
