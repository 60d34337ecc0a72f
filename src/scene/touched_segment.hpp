// touched_segment.hpp: the counterpart of a contact, if not the ground: a node, or a point on a segment.
//
//   u_b = sum_j w_j u_j,   segment B-C:  w = (1 - x, x),  x = (P - B).(C - B) / |C - B|^2,  0 <= x <= 1
//
// P: the undeformed position of the contact's own node. Displacements are small, so x is constant.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scene/readers.hpp"

namespace signorini {

/// Nodes and weights from the key `against`. Errors: SceneError for unknown or equal nodes, a segment of length zero, a
/// point beside the segment.
[[nodiscard]] std::vector<std::pair<std::string, double>> read_touched(Table& contact, const Scene& scene,
                                                                       const Space& space,
                                                                       const std::string& node);

}  // namespace signorini
