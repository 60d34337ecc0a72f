// drawn_lines.hpp: data for drawing members between named nodes, for the page and ParaView.
//
//   shapes[k]  rows s, a, turn_a, b, turn_b:  v(s) = a v_a + b v_b + L (turn_a rz_a + turn_b rz_b) across, linear along
//
// k: 0 straight, 1 bent, 2 bent and hinged at a, 3 hinged at b. Page and ParaView know the shape functions only from
// these rows.
#pragma once

#include "base/json.hpp"
#include "model/element/element_kinds.hpp"

namespace signorini {

[[nodiscard]] Json shapes_json();

/// Index into shapes_json().
[[nodiscard]] int shape_of(const MemberLine& line);

/// Shape functions across the line, from a row.
[[nodiscard]] LineShapes across_of(const Json& row);

/// For nodes and curve of run_data(): the largest displacement is drawn with at most an eighth of the structure's
/// larger extent. greatest: largest displacement of nodes without a curve.
[[nodiscard]] double fitting_magnification(const Json& nodes, const Json& curve, double greatest = 0.0);

}  // namespace signorini
