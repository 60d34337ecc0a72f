// simple_motions.hpp: free motions in the simplest terms.
//
//   span N contains  e_x, e_y, theta x (r - centre)?   these first, then what is left of N
//
// A null space has no preferred basis: a body that can fly has infinitely many rotations about points. Those
// who read the name of a motion expect "vertical motion" where that is one of them.
#pragma once

#include <vector>

#include "model/assembly/dofs.hpp"

namespace signorini {

/// Another basis of the columns of `motions` (n x m, full rank): horizontal and vertical motion and the
/// rotation about the centre of the nodes where they belong to the space, then a complement. Unchanged
/// when it holds none of them, and in matrix scenes.
[[nodiscard]] Eigen::MatrixXd simple_motions(const Eigen::MatrixXd& motions, const DofMap& map);

/// The same for motions that only move these degrees of freedom.
[[nodiscard]] Eigen::MatrixXd simple_motions(const Eigen::MatrixXd& motions, const DofMap& map,
                                             const std::vector<int>& dofs);

}  // namespace signorini
