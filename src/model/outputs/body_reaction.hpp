// body_reaction.hpp: what a support of a rigid body's node bears.
//
//   G l = F,   F = ( sum fx, sum fy, sum of (r - r_c) x f + m ) of inertia and inner forces less loads at the nodes
//   l = (G^T G)^-1 G^T F
//
// A column of G for each support: (1, 0, -(y - y_c)), (0, 1, x - x_c), (0, 0, 1). Three supports can be told apart,
// if none follows from the others. Moments count over the size of the body.
#pragma once

#include "model/outputs/structure_rows.hpp"

namespace signorini {

/// The reaction asked for: along d (x, y, rotation) at a node of a body.
struct BodyReaction {
  int body = 0, node = 0;
  std::array<double, 3> d{};
  SourcePlace place;
  std::string key;
};

/// Mesh nodes of a body.
[[nodiscard]] std::vector<int> nodes_of_body(const DofMap& map, int body);

/// Errors: SceneError where the supports of the body bear it together in ways that nothing decides.
void add_body_reaction(const Scene& scene, const DofMap& map, const StructureRows& rows,
                       const BodyReaction& asked, PhysicalRow& row);

}  // namespace signorini
