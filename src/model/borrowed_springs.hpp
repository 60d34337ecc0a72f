// borrowed_springs.hpp: rigid contacts where the structure has no mass.
//
//   K u = f + B l,   B^T u + ... = g: 0 <= g _|_ l >= 0          l: forces of these contacts along B, n or t each
//   u = u' + S D l,  S = B (B^T B)^-1,  D = L^-1,  G = S^T K S,  X = (L - G)^-1:
//   K' u' = f' + B l,   K' = K + K S X S^T K,   f' = f + K S X S^T f,   l = -L g' where the contact is closed
//   u = u' + S X S^T (K u' - f),   energy of the structure and work of loads: less by f^T S X S^T f / 2
//
// Parts without mass follow at once, so a rigid contact there is a row g = 0 on displacements, and in stick ut = const; what
// decides is a static complementarity problem, without restitution. It has the same form as that of a compliant contact
// in series with a stiffer structure: some compliance D is taken from the structure and given to the contact as its
// springs L. Gaps, slips, forces, energies are those of the rigid contact, whatever L is. L = 2 sum_j |G_ij| makes L - G
// positive definite, and K' at most twice as stiff along B as K.
//
// Uniqueness is that of any contact without mass: where friction couples the normal to the tangent too strongly,
// check_unique refuses.
#pragma once

#include <vector>

#include "signorini/model.hpp"

namespace signorini {

struct BorrowedSprings {
  struct Row {
    std::size_t contact = 0;
    bool normal = true;
  };
  std::vector<Row> rows;       ///< columns of S
  SparseMatrix shifts;         ///< S
  SparseMatrix displacements;  ///< u = this * u'
};

/// Changes K, loads and contacts (law, stiffnesses, `borrows`); nothing: no rigid contact acts on parts without mass. After
/// the loads, before the initial state; dampers: C without alpha M + beta K. Errors: SceneError where a damper acts on
/// these parts, where contacts share a motion of theirs, or where a contact reaches them by half.
[[nodiscard]] std::optional<BorrowedSprings> borrow_springs(const Scene& scene, const SparseMatrix& dampers,
                                                            Model& model);

/// Of a run that goes on: u' from u, gaps and places likewise. Errors: SceneError where the run left no row of its contacts.
void continue_borrowed(const BorrowedSprings& springs, const Scene& scene, Model& model);

/// Outputs, columns and drawing see u; the model is reduced, or complete.
void show_borrowed(const BorrowedSprings& springs, Model& model);

/// Errors: SceneError where the forces of a contact that slides would not be unique: f |F_nt| >= F_nn, F the compliance of
/// parts without mass at it.
void check_unique(const Scene& scene, const Model& model);

}  // namespace signorini
