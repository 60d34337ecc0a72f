// delassus.hpp: what forces at contacts do to the accelerations of all of them.
//
//   W = H^T A^-1 H,   H = (n_1, t_1, n_2, ...),   A: the system of the mode, solved for accelerations
//
// Impulses change velocities by the same matrix. Unit: 1/mass.
#pragma once

#include <Eigen/Core>

#include "motion/mode_system.hpp"

namespace signorini {

/// The columns of H for the given contacts, their effect on all degrees of freedom, and on each other.
struct Delassus {
  Eigen::MatrixXd
      effect;  ///< n x places of the list: accelerations for unit forces (l along n, k along t); 0 without mass
  Eigen::MatrixXd W;  ///< places x places of the list
};

/// A velocity along n or t of one of the contacts that is known exactly. row: decide/places.hpp.
struct Fixed {
  Eigen::Index row;
  const Combination* form;
  double value;
};
/// v has these velocities exactly.
[[nodiscard]] bool settled(const std::vector<Fixed>& fixed, const Vector& v);
/// v with these velocities to the last digit, by the smallest change in the norm of M: what computed v has
/// them to the rounding of an elimination only. Returns the impulses that do it, one a row of `delassus`; empty: none.
Eigen::VectorXd settle(const Delassus& delassus, const std::vector<Fixed>& fixed, Vector& v);

[[nodiscard]] Delassus delassus(const Model& model, const ModeSystem& system,
                                const std::vector<std::size_t>& contacts);

/// Of impulses on a list of contacts (decide/places.hpp): they themselves, and what rows in force of others, as of a slider
/// that sticks, give against them. Slots as those of forces. Empty: no impulses.
[[nodiscard]] Eigen::VectorXd with_reactions(const Model& model, const ModeSystem& system,
                                             const std::vector<std::size_t>& contacts,
                                             const Eigen::VectorXd& impulses);

}  // namespace signorini
