// delassus.hpp: accelerations of contacts due to forces at all of them.
//
//   W = H^T A^-1 H,   H = (n_1, t_1, n_2, ...),   A: the system of the states, solved for accelerations
//
// Impulses change velocities by the same matrix. Unit: 1/mass.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "contact/law.hpp"
#include "contact/motion.hpp"
#include "decide/coulomb_problem.hpp"
#include "motion/state_systems.hpp"

namespace signorini::decide {

/// Effect of forces at the listed contacts on all degrees of freedom, and on the listed contacts.
struct Delassus {
  Eigen::MatrixXd
      effect;  ///< n x places of the list: accelerations for unit forces (l along n, k along t); 0 at massless degrees
               ///< of freedom
  Eigen::MatrixXd W;   ///< places x places of the list; unused places: zero
  ForceLayout layout;  ///< of the list
};

/// A velocity along n or t of a listed contact that is known exactly. row: decide/coulomb_problem.hpp.
struct FixedVelocity {
  Eigen::Index row;
  const Combination* form;
  double value;
};
/// True if v has exactly these velocities.
[[nodiscard]] bool has_velocities(const std::vector<FixedVelocity>& fixed, const Vector& v);
/// Makes these velocities in v exact, by the smallest change in the norm of M; before, they have the rounding
/// of an elimination. Returns the impulses of this change, one per row of `delassus`; empty: none.
Eigen::VectorXd impose_velocities(const Delassus& delassus, const std::vector<FixedVelocity>& fixed,
                                  Vector& v);

/// The matrices for these contacts, in the states of the system.
[[nodiscard]] Delassus delassus(const Model& model, const motion::StateSystem& system,
                                const std::vector<std::size_t>& contacts);

/// Impulses on the listed contacts (decide/coulomb_problem.hpp), together with the reactions of other
/// constraint rows, such as those of a sticking slider. Indexed like forces. Empty: no impulses.
[[nodiscard]] Eigen::VectorXd with_reactions(const Model& model, const motion::StateSystem& system,
                                             const std::vector<std::size_t>& contacts,
                                             const Eigen::VectorXd& impulses);

// Checks that contact states determine the forces of rigid contacts.
//
//   A = H^T M^-1 (H - s f T),   H: normals of closed contacts, tangents of sticking ones;  A_ij / sqrt(A_ii A_jj)
//
// The forces are unique if A is regular. An elimination of dependent rows ends with a pivot of rounding size,
// and may not detect it: the computed forces then have any size and sign, with noise of the same size.

/// True if the noise of a rigid contact's force exceeds a thousandth of the largest force: the forces may
/// then not be unique, and forces_are_unique() decides.
[[nodiscard]] bool forces_are_noise(const Model& model, const std::vector<MotionJet>& jets);

/// False if the smallest singular value of the scaled A is zero up to rounding.
[[nodiscard]] bool forces_are_unique(motion::StateSystems& systems, const contact::ContactStates& states);

// Forces of least norm, for rigid contacts and sliders whose forces the accelerations do not determine.
//
//   min sum ( l_i^2 + k_i^2 )   over   W f = W f_0,   (l_i, k_i) in the cone of contact i
//
//   contact i presses and rests    0 <= l,  |k| <= fs l        pressed by a given l:  |k| <= fs l
//   contact i presses and slips    0 <= l,  k = -f l sign(rt)
//   without friction               0 <= l
//
// f_0 is one solution of a complementarity problem. Two sticking feet of a body may share the friction in
// other ways with the same accelerations; feet at unequal heights may also share the compression in other
// ways. The forces of least norm are unique: they depend neither on the order of contacts nor on the method
// that found f_0. A contact whose force of least norm lies on its cone is at its limit.

/// Replaces the forces in the solution by those of least norm, where no response changes. may_share: items
/// whose motion other items may hold as well.
void min_norm_forces(const CoulombProblem& problem, const std::vector<bool>& may_share,
                     CoulombSolution& solution);

}  // namespace signorini::decide
