// pieces.hpp: finite elements as lines: their axes, the pieces that they make up, forces along them.
//
//   q along x and y on an element of length L:  q_x L/2, q_y L/2 at both ends, and, where it bends,
//   +- q_across L^2/12 as moments
#pragma once

#include <array>
#include <utility>

#include "model/assembly/dofs.hpp"

namespace signorini {

/// Length of an element, cosine and sine of its direction, and what it spans.
struct Axis {
  double length, c, s, dx, dy;
};
[[nodiscard]] Axis axis_of(const Mesh& mesh, const MeshElement& element);

/// The one piece of a member between two nodes, and whether it runs the other way. Errors: SceneError.
[[nodiscard]] std::pair<const MeshPiece*, bool> piece_between(const DofMap& map, const std::string& a,
                                                              const std::string& b, const SourcePlace& place,
                                                              const std::string& key);

/// Components along x and y of a distributed load of one on an element; backwards: given against its course.
[[nodiscard]] std::array<double, 2> along_element(const LoadSpec& spec, const Axis& axis, bool backwards);

/// What a force per length does to the ends of an element: ux, uy, rz at both.
[[nodiscard]] std::array<double, 6> uniform_forces(MemberType type, const Axis& axis,
                                                   const std::array<double, 2>& q);

}  // namespace signorini
