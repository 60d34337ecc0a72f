#include "model/assembly/pieces.hpp"

#include <fmt/core.h>

namespace signorini {

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
    throw SceneError(place, key, fmt::format("no member has nodes '{}' and '{}' next to each other", a, b));
  return {found, found->from != from};
}

std::array<double, 2> along_line(const LoadSpec& spec, const Axis& axis, bool backwards) {
  const auto& q = spec.direction.vector;
  if (!spec.member_axes) return q;
  const double turn = backwards ? -1.0 : 1.0;
  return {turn * (q[0] * axis.c - q[1] * axis.s), turn * (q[0] * axis.s + q[1] * axis.c)};
}

}  // namespace signorini
