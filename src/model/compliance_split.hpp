// compliance_split.hpp: rigid contacts on parts without mass.
//
//   K u = f + B l,   B^T u + ... = g: 0 <= g _|_ l >= 0          l: contact forces along the columns of B (n or t)
//   u = u' + S D l,  S = B (B^T B)^-1,  D = L^-1,  G = S^T K S,  X = (L - G)^-1:
//   K' u' = f' + B l,   K' = K + K S X S^T K,   f' = f + K S X S^T f,   l = -L g' where the contact is closed
//   u = u' + S X S^T (K u' - f),   energy of the structure and work of loads: smaller by f^T S X S^T f / 2
//
// Parts without mass respond immediately. A rigid contact on such a part is therefore a constraint g = 0 on
// displacements (and a constant ut while it sticks). Its state is the solution of a static complementarity problem without
// restitution. A compliant contact in series with a stiffer structure has the same equations: a part D of the
// structure's compliance becomes the springs L of the contact. Gaps, slips, forces and energies are those of
// the rigid contact for any L. L = 2 sum_j |G_ij| makes L - G positive definite, and K' at most twice as
// stiff along B as K.
//
// As for any contact without mass, the solution is not unique if friction couples the normal to the tangent
// too strongly; check_unique_forces() refuses this.
#pragma once

#include <vector>

#include "signorini/model.hpp"

namespace signorini::model {

struct ComplianceSplit {
  struct Row {
    std::size_t contact = 0;
    bool normal = true;  ///< false: tangent
  };
  std::vector<Row> rows;       ///< one entry for each column of S
  SparseMatrix shifts;         ///< S
  SparseMatrix displacements;  ///< u = displacements * u'
};

/// Changes K, loads and contacts (law and stiffnesses). To be called after the loads, before the initial
/// state. dampers: C without alpha M + beta K. Returns nullopt if no rigid contact acts on parts without mass.
/// Errors: SceneError if a damper acts on these parts, if several contacts constrain the same motion of these
/// parts, or if a contact also acts on parts with mass.
[[nodiscard]] std::optional<ComplianceSplit> split_compliance(const Scene& scene, const SparseMatrix& dampers,
                                                              Model& model);

/// For a continued run: sets u' from the final u of the previous run, and changes gaps and positions of contacts
/// accordingly. Errors: SceneError if contacts.csv of the previous run has no rows of these contacts.
void continue_split(const ComplianceSplit& springs, const Scene& scene, Model& model);

/// Expresses outputs, columns and drawing, which show u, in terms of u'. To be called after the model is
/// complete, or after the reduction.
void map_outputs(const ComplianceSplit& springs, Model& model);

/// Uses the compliance F of the parts without mass at their contacts; F_nt: displacement along n by a force along t.
/// f: friction coefficient. Errors: SceneError if f |F_nt| >= F_nn at one contact: its forces while it slides would
/// not be unique. Warns if the symmetric part of F_nn - s F_nt diag(f) is not positive definite for s = 1 or -1:
/// the forces of contacts that slide in the same direction may then not be unique.
void check_unique_forces(const Scene& scene, Model& model);

}  // namespace signorini::model
