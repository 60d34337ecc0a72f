// static_system.hpp: equilibrium of a structure with given closed contacts.
//
//   (K + sum_closed kn n n^T) u = P - sum_closed kn g0 n,    t_h . u = 0 at the holders h
//   rigid ones: n . u = -g0 by a multiplier N, P - n N
//               kn then is as stiff as the structure; it does not affect the solution
#pragma once

#include <vector>

#include "model/assembly/dofs.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// A spring constant along the form, as stiff as the structure.
[[nodiscard]] double own_stiffness(const SparseMatrix& k, const Combination& form);

struct StaticProblem {
  const SparseMatrix& stiffness;
  const Vector& load;
  const std::vector<Contact>& contacts;
  const DofMap& map;
  double firmness = 1.0;  ///< stiffness of rigid contacts, in units of the structure's own
  bool forces = false;    ///< request: contacts that hold loose motions must carry no other forces

  [[nodiscard]] int size() const { return static_cast<int>(load.size()); }
  [[nodiscard]] bool is_support(std::size_t k) const { return !contacts[k].normal_force_given(); }
  [[nodiscard]] double normal_stiffness(std::size_t k) const {
    return contacts[k].takes_impulses() ? firmness * own_stiffness(stiffness, contacts[k].normal)
                                        : contacts[k].normal_stiffness;
  }
  [[nodiscard]] double gap(std::size_t k, const Vector& u) const { return contacts[k].gap_at(u); }
  /// K with the springs of the closed contacts; closed[k] is ignored for sliders.
  [[nodiscard]] SparseMatrix matrix(const std::vector<bool>& closed) const;
  /// P - sum_closed kn g0 n
  [[nodiscard]] Vector right_side(const std::vector<bool>& closed) const;
};

/// A free motion and the contact whose ut = 0 fixes it (-1: none, it stays at zero).
struct FreeMotion {
  Vector motion;
  int holder = -1;
};

/// The free motions of the null space `null` (n x m), one per holding contact: contacts in file order, closed ones and
/// sliders first, open ones last unless `pressed_only`. Motions are scaled to t_h . motion = 1 at their own contact and
/// 0 at the others.
[[nodiscard]] std::vector<FreeMotion> hold_motions(const StaticProblem& problem, const Eigen::MatrixXd& null,
                                                   const std::vector<bool>& closed,
                                                   bool pressed_only = false);

/// The displacement with the free motions held, and -N of every contact; for closed rigid contacts the required
/// reaction, with either sign.
struct HeldState {
  Vector u;
  std::vector<double> reactions;
};
[[nodiscard]] HeldState solve_held(const StaticProblem& problem, const std::vector<bool>& closed,
                                   const std::vector<FreeMotion>& held);

/// Work of the loads on a free motion, at the displacement u of solve_held: zero in equilibrium. k and p: matrix() and
/// right_side() of the problem. Work below rounding, or below 1e-9 of the largest load times the largest displacement,
/// counts as zero.
[[nodiscard]] double driving_work(const StaticProblem& problem, const SparseMatrix& k, const Vector& p,
                                  const Vector& motion, const Vector& u);

}  // namespace signorini
