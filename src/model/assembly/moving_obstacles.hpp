// moving_obstacles.hpp: nodes that touch a node whose support moves.
//
//   u = w + s(t)          u: motion of the touching node, s: motion of the obstacle
//   g = g0 + n . (u - s) = g0 + n . w,     slip along t . w
//
// Gaps and slips depend on degrees of freedom, not on time. So w is the degree of freedom, "ball-table.uy", and u is a tied
// motion (ties.hpp): masses, members and springs at the node then add the load -M s'' - C s' - K s. Of a node of a rigid
// body, the motion of the whole body is relative to the obstacle. A node has one such s for each component.
#pragma once

#include "model/assembly/dofs.hpp"
#include "model/assembly/ties.hpp"

namespace signorini::assembly {

/// Makes motions of nodes relative to the obstacles that they touch. Must be called after tie(). Errors: SceneError for a
/// node that touches obstacles of different motions, or that is fixed where its obstacle moves.
void follow_obstacles(const Scene& scene, DofMap& map);

/// A motion relative to an obstacle, and the obstacle's motion as terms of moving supports.
struct RelativeMotion {
  int dof = 0;
  std::vector<TiedTerm> obstacle;
};
[[nodiscard]] std::vector<RelativeMotion> relative_motions(const DofMap& map);

}  // namespace signorini::assembly
