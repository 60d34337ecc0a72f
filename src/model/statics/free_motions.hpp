// free_motions.hpp: motions without stiffness in a frictionless equilibrium, and the contacts that hold them.
//
//   (K + sum_closed kn n n^T) z = 0,   n . z = 0 at closed rigid contacts          z: free motions, the columns of Z
//
// Loads that do no work on the free motions leave u + Z c in equilibrium for every c. The contacts share the motion
// so that they slip least, each with the weight of its force:
//
//   min over c of  sum |N_k| (t_k . (u + Z c))^2                    k: compressed contacts, and sliders with a force
//
// The rule knows no order, no axes and no mirror, two halves of a contact count as the whole, and a contact whose
// force vanishes has no part in it. Motions that move no such contact are fixed by open ones, each with the weight 1.
// Motions that move no contact at all are set to zero: min sum D_i u_i^2, D: stiffness of each degree of freedom, for
// translations that of the node.
#pragma once

#include <string>
#include <vector>

#include "model/statics/static_system.hpp"
#include "signorini/model.hpp"

namespace signorini::statics {

/// A free motion of a basis in which each motion slips at its own contact, as far as contacts hold it.
struct FreeMotion {
  Vector motion;
  /// A row that this motion moves, and no other motion of the basis with a contact: it makes the matrix regular.
  Combination pin;
  std::vector<std::size_t> contacts;  ///< contacts that hold the motion; empty: no contact
};

/// A basis of the null space `null` (n x m). Closed contacts and sliders hold motions first, then open contacts
/// unless `pressed_only`.
[[nodiscard]] std::vector<FreeMotion> constrain_free_motions(const StaticProblem& problem,
                                                             const Eigen::MatrixXd& null,
                                                             const std::vector<bool>& closed,
                                                             bool pressed_only = false);

/// Numbers of forms that fix the motions (n x m), at most m: each is the one that the motions left by the ones before
/// move most. Fewer than m: some motions move none of the forms.
[[nodiscard]] std::vector<std::size_t> fixing_forms(const Eigen::MatrixXd& motions,
                                                    const std::vector<const Combination*>& forms);

/// "contact 'a'", "contacts 'a' and 'b'".
[[nodiscard]] std::string names_of_contacts(const std::vector<Contact>& contacts,
                                            const std::vector<std::size_t>& list);

/// The displacement with the free motions shared, and -N of every contact. At closed rigid contacts -N is the reaction that
/// keeps the gap closed, with either sign.
struct ConstrainedState {
  Vector u;
  std::vector<double> reactions;
};
[[nodiscard]] ConstrainedState solve_constrained(const StaticProblem& problem,
                                                 const std::vector<bool>& closed,
                                                 const std::vector<FreeMotion>& free);

/// True if the reaction is zero up to rounding: its work along the normal is below 1e-9 of the largest work of the loads.
[[nodiscard]] bool has_no_reaction(const StaticProblem& problem, std::size_t contact, double reaction);

/// Force of each contact that holds free motions, 0 for contacts that do not. reactions: -N.
[[nodiscard]] std::vector<double> holding_forces(const StaticProblem& problem,
                                                 const std::vector<bool>& closed,
                                                 const std::vector<double>& reactions);

/// Work of the loads on a free motion, at the displacement u of solve_constrained(); zero in equilibrium. k and p: matrix()
/// and right_side() of the problem. Work below rounding, or below 1e-9 of the largest load times the largest displacement, is
/// set to zero.
[[nodiscard]] double driving_work(const StaticProblem& problem, const SparseMatrix& k, const Vector& p,
                                  const Vector& motion, const Vector& u);

}  // namespace signorini::statics
