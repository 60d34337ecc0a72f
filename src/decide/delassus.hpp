// delassus.hpp: accelerations of contacts due to forces at all of them.
//
//   W = H^T A^-1 H,   H = (n_1, t_1, n_2, ...),   A: the system of the mode, solved for accelerations
//
// Impulses change velocities by the same matrix. Unit: 1/mass.
#pragma once

#include <Eigen/Core>

#include "motion/mode_system.hpp"

namespace signorini {

/// Effect of forces at the listed contacts on all degrees of freedom, and on the listed contacts.
struct Delassus {
  Eigen::MatrixXd
      effect;  ///< n x places of the list: accelerations for unit forces (l along n, k along t); 0 at massless degrees
               ///< of freedom
  Eigen::MatrixXd W;  ///< places x places of the list
};

/// A velocity along n or t of a listed contact that is known exactly. row: decide/places.hpp.
struct Fixed {
  Eigen::Index row;
  const Combination* form;
  double value;
};
/// True if v has exactly these velocities.
[[nodiscard]] bool settled(const std::vector<Fixed>& fixed, const Vector& v);
/// Gives v these velocities to the last digit, by the smallest change in the norm of M; the computed v has them only up
/// to the rounding of an elimination. Returns the impulses of this change, one per row of `delassus`; empty: none.
Eigen::VectorXd settle(const Delassus& delassus, const std::vector<Fixed>& fixed, Vector& v);

[[nodiscard]] Delassus delassus(const Model& model, const ModeSystem& system,
                                const std::vector<std::size_t>& contacts);

/// Impulses on the listed contacts (decide/places.hpp), together with the reactions of other constraint rows, such as
/// those of a sticking slider. Indexed like forces. Empty: no impulses.
[[nodiscard]] Eigen::VectorXd with_reactions(const Model& model, const ModeSystem& system,
                                             const std::vector<std::size_t>& contacts,
                                             const Eigen::VectorXd& impulses);

}  // namespace signorini
