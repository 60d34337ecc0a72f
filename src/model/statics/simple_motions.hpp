// simple_motions.hpp: rigid-body motions in the simplest basis.
//
//   span N contains  e_x, e_y, theta x (r - centre)?   these first, then the complement in N
//
// A null space has no preferred basis: a free body has infinitely many rotations about points. Messages shall name
// "vertical motion" if it is one of the motions.
#pragma once

#include <vector>

#include "model/assembly/dofs.hpp"

namespace signorini {

/// Another basis of the columns of `motions` (n x m, full rank): horizontal and vertical motion and the rotation about
/// the centre of the nodes, if they belong to the space, then a complement. Unchanged if the space contains none of
/// them, and in matrix scenes.
[[nodiscard]] Eigen::MatrixXd simple_motions(const Eigen::MatrixXd& motions, const DofMap& map);

/// Same for motions that only involve these degrees of freedom.
[[nodiscard]] Eigen::MatrixXd simple_motions(const Eigen::MatrixXd& motions, const DofMap& map,
                                             const std::vector<int>& dofs);

}  // namespace signorini
