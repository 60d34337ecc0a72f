// delassus.hpp: the Delassus matrix W: accelerations at contacts due to forces at contacts.
//
//   W = H^T A^-1 H,   H = (n_1, t_1, n_2, ...),   A: matrix of the contact states for accelerations
//
// W also gives the velocity changes at contacts due to impulses. Unit: 1/mass.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "contact/law.hpp"
#include "contact/motion.hpp"
#include "decide/coulomb_problem.hpp"
#include "motion/state_systems.hpp"

namespace signorini::decide {

/// Effect of forces at the listed contacts: on all degrees of freedom, and on the listed contacts.
struct Delassus {
  /// n x places of the list: accelerations due to unit forces (l along n, k along t); 0 at massless degrees of freedom.
  Eigen::MatrixXd effect;
  Eigen::MatrixXd W;   ///< matrix W of the listed contacts; rows and columns of unused places are zero
  ForceLayout layout;  ///< layout of the listed contacts
};

/// A velocity along n or t of a listed contact that is known exactly. row: place of the velocity (decide/coulomb_problem.hpp).
struct FixedVelocity {
  Eigen::Index row;
  const Combination* form;
  double value;
};
/// True if the velocities in v are bitwise equal to these values.
[[nodiscard]] bool has_velocities(const std::vector<FixedVelocity>& fixed, const Vector& v);
/// Sets these velocities in v exactly, by the smallest change of v in the norm of M. Before the call they contain rounding
/// errors of an elimination. Returns the impulses of this change, one per row of `delassus`; empty: no change.
Eigen::VectorXd impose_velocities(const Delassus& delassus, const std::vector<FixedVelocity>& fixed,
                                  Vector& v);

/// Computes the matrices for the listed contacts. system: equations of motion in the contact states for which W is valid.
[[nodiscard]] Delassus delassus(const Model& model, const motion::StateSystem& system,
                                const std::vector<std::size_t>& contacts);

/// Adds to given impulses on the listed contacts the reaction impulses of other constraints, such as a sticking slider. Returns
/// impulses on all contacts, in the order of forces. Empty: no impulses.
[[nodiscard]] Eigen::VectorXd with_reactions(const Model& model, const motion::StateSystem& system,
                                             const std::vector<std::size_t>& contacts,
                                             const Eigen::VectorXd& impulses);

// Checks whether contact states determine the forces of rigid contacts uniquely.
//
//   A = H^T M^-1 (H - s f T),   H: normals of closed contacts, tangents of sticking ones;  A_ij / sqrt(A_ii A_jj)
//
// The forces are unique if A is regular. If rows are linearly dependent, an elimination ends with a pivot of rounding size and
// may not detect the dependence. The computed forces then have arbitrary size and sign, with noise of the same size.

/// True if the noise of a rigid contact's force exceeds a thousandth of the largest force. The forces may then not be unique;
/// forces_are_unique() decides.
[[nodiscard]] bool forces_are_noise(const Model& model, const std::vector<MotionJet>& jets);

/// False if the smallest singular value of the scaled A is zero up to rounding.
[[nodiscard]] bool forces_are_unique(motion::StateSystems& systems, const contact::ContactStates& states);

// Forces of least norm, for rigid contacts and sliders whose forces are not determined uniquely by the accelerations.
//
//   min sum ( l_i^2 + k_i^2 )   over   W f = W f_0,   (l_i, k_i) in the cone of contact i
//
//   contact i is closed and sticks    0 <= l,  |k| <= fs l        l is given:  |k| <= fs l
//   contact i is closed and slips     0 <= l,  k = -f l sign(rt)
//   contact i has no friction         0 <= l
//
// f_0 is one solution of the Coulomb problem. Two sticking feet of one body may share the friction in different ways
// with equal accelerations; feet at unequal heights may also share the compression in different ways. The forces of least
// norm are unique: they depend neither on the order of contacts nor on the method that found f_0. A contact is at its limit
// if its force of least norm lies on its friction cone.

/// Replaces the forces in the solution by forces of least norm; no response changes. may_share: one entry per item; true: other
/// items may constrain the motion of this item, too.
void min_norm_forces(const CoulombProblem& problem, const std::vector<bool>& may_share,
                     CoulombSolution& solution);

}  // namespace signorini::decide
