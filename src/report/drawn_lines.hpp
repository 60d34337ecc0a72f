// drawn_lines.hpp: how page and ParaView draw members between named nodes, as data.
//
//   shapes[k]  rows s, a, turn_a, b, turn_b:  v(s) = a v_a + b v_b + L (turn_a rz_a + turn_b rz_b) across, linear along
//
// k: 0 straight, 1 bent, 2 bent and hinged at a, 3 hinged at b. Neither knows shape functions but by these rows.
#pragma once

#include "base/json.hpp"
#include "model/element/element_kinds.hpp"

namespace signorini {

[[nodiscard]] Json shapes_json();

/// Index into shapes_json().
[[nodiscard]] int shape_of(const MemberLine& line);

/// Of a row.
[[nodiscard]] LineShapes across_of(const Json& row);

/// Of nodes and curve of run_data(): the greatest displacement is at most an eighth of the structure's greater extent.
/// greatest: that of nodes without a curve.
[[nodiscard]] double fitting_magnification(const Json& nodes, const Json& curve, double greatest = 0.0);

}  // namespace signorini
