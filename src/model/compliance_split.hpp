// compliance_split.hpp: rigid contacts on parts without mass.
//
//   K u = f + B l,   B^T u + ... = g: 0 <= g _|_ l >= 0          l: forces of these contacts along B, n or t each
//   u = u' + S D l,  S = B (B^T B)^-1,  D = L^-1,  G = S^T K S,  X = (L - G)^-1:
//   K' u' = f' + B l,   K' = K + K S X S^T K,   f' = f + K S X S^T f,   l = -L g' where the contact is closed
//   u = u' + S X S^T (K u' - f),   energy of the structure and work of loads: less by f^T S X S^T f / 2
//
// Parts without mass respond immediately, so a rigid contact there is a constraint row g = 0 on displacements, with ut
// = const in stick, and its state follows from a static complementarity problem without restitution. This has the same
// form as a compliant contact in series with a stiffer structure: some compliance D is taken from the structure and
// given to the contact as its springs L. Gaps, slips, forces and energies are those of the rigid contact for any L. L =
// 2 sum_j |G_ij| makes L - G positive definite, and K' at most twice as stiff along B as K.
//
// The solution is not unique, like that of any contact without mass, if friction couples the normal to the tangent too
// strongly; check_unique_forces refuses this.
#pragma once

#include <vector>

#include "signorini/model.hpp"

namespace signorini::model {

struct ComplianceSplit {
  struct Row {
    std::size_t contact = 0;
    bool normal = true;
  };
  std::vector<Row> rows;       ///< columns of S
  SparseMatrix shifts;         ///< S
  SparseMatrix displacements;  ///< u = this * u'
};

/// Changes K, loads and contacts (law, stiffnesses, `borrows`); nullopt: no rigid contact acts on parts without mass.
/// To be called after the loads, before the initial state; dampers: C without alpha M + beta K. Errors: SceneError if a
/// damper acts on these parts, if contacts share a motion of theirs, or if a contact acts on them only partly.
[[nodiscard]] std::optional<ComplianceSplit> split_compliance(const Scene& scene, const SparseMatrix& dampers,
                                                              Model& model);

/// For a continued run: u' from u, gaps and positions likewise. Errors: SceneError if that run has no row of its
/// contacts.
void continue_split(const ComplianceSplit& springs, const Scene& scene, Model& model);

/// Makes outputs, columns and drawing refer to u; to be called when the model is complete or reduced.
void map_outputs(const ComplianceSplit& springs, Model& model);

/// Errors: SceneError if the forces of a sliding contact would not be unique: f |F_nt| >= F_nn, F being the compliance
/// of parts without mass at it. A warning if the forces of contacts that slide in the same direction may not be unique
/// together: the symmetric part of F_nn - s F_nt diag(f), s = 1 or -1, is not positive definite (sufficient for
/// uniqueness).
void check_unique_forces(const Scene& scene, Model& model);

}  // namespace signorini::model
