// delassus.hpp: what forces at contacts do to the accelerations of all of them.
//
//   W = H^T A^-1 H,   H = (n_1, t_1, n_2, ...),   A: the system of the mode, solved for accelerations
//
// Impulses change velocities by the same matrix. Unit: 1/mass.
#pragma once

#include <Eigen/Core>

#include "engine/jet.hpp"

namespace signorini {

/// The columns of H for the given contacts, their effect on all degrees of freedom, and on each other.
struct Delassus {
  Eigen::MatrixXd effect;  ///< n x 2m: accelerations for unit forces (l along n, k along t); 0 without mass
  Eigen::MatrixXd W;       ///< 2m x 2m
};

/// In the mode that the expander has in force.
[[nodiscard]] Delassus delassus(const Model& model, const Expander& expander,
                                const std::vector<std::size_t>& contacts);

}  // namespace signorini
