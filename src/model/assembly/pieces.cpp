#include "model/assembly/pieces.hpp"

#include <fmt/core.h>

#include <cmath>

namespace signorini {

Axis axis_of(const Mesh& mesh, const MeshElement& element) {
  const MeshNode& a = mesh.nodes[static_cast<std::size_t>(element.a)];
  const MeshNode& b = mesh.nodes[static_cast<std::size_t>(element.b)];
  const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
  return {length, dx / length, dy / length, dx, dy};
}

std::pair<const MeshPiece*, bool> piece_between(const DofMap& map, const std::string& a, const std::string& b,
                                                const SourcePlace& place, const std::string& key) {
  const int from = find_node(map.mesh, a, place, key), to = find_node(map.mesh, b, place, key);
  const MeshPiece* found = nullptr;
  for (const MeshPiece& piece : map.mesh.pieces) {
    const bool joins = (piece.from == from && piece.to == to) || (piece.from == to && piece.to == from);
    if (!joins) continue;
    if (found)
      throw SceneError(place, key, fmt::format("two members join nodes '{}' and '{}', expected one", a, b));
    found = &piece;
  }
  if (!found)
    throw SceneError(place, key, fmt::format("no piece of a member joins nodes '{}' and '{}'", a, b));
  return {found, found->from != from};
}

std::array<double, 2> along_element(const LoadSpec& spec, const Axis& axis, bool backwards) {
  const auto& q = spec.direction.vector;
  if (!spec.member_axes) return q;
  const double turn = backwards ? -1.0 : 1.0;
  return {turn * (q[0] * axis.c - q[1] * axis.s), turn * (q[0] * axis.s + q[1] * axis.c)};
}

std::array<double, 6> uniform_forces(MemberType type, const Axis& axis, const std::array<double, 2>& q) {
  const double length = axis.length, across = -q[0] * axis.s + q[1] * axis.c;
  const double moment = type == MemberType::bar ? 0.0 : across * length * length / 12.0;
  return {0.5 * q[0] * length, 0.5 * q[1] * length, moment,
          0.5 * q[0] * length, 0.5 * q[1] * length, -moment};
}

}  // namespace signorini
