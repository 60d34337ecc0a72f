// static_system.hpp: equilibrium of a structure with given closed contacts.
//
//   (K + sum_closed kn n n^T) u = P - sum_closed kn g0 n
//   rigid contacts: n . u = -g0 is enforced by a multiplier N (load P - n N); kn is the structure's own stiffness
//                   and does not affect the solution
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "linear/sparse_cholesky.hpp"
#include "model/assembly/dofs.hpp"
#include "model/assembly/springs.hpp"
#include "signorini/model.hpp"

namespace signorini::statics {

// A structure with constraint rows.
//
//   K u + sum_j d_j F_j = P,    d_j . u - c_j F_j = r_j        c_j = 0: rigid
//
// Rows with a compliance are springs in the matrix. Rigid rows are added to the matrix with the structure's own
// stiffness and enforced by multipliers (a dense Schur complement, with one unknown per rigid row).

/// d . u - c F = r: an active constraint row; F is the force along -d.
struct ConstraintRow {
  Combination form;
  double stiffness = 0.0;  ///< 1 / c; for a rigid row the structure's own stiffness, without effect on u
  bool rigid = false;
};

/// True if other rigid rows that are not loose also prevent the motion along `row`; the force of `row` is then
/// not unique.
[[nodiscard]] bool is_also_constrained(const std::vector<ConstraintRow>& rows, const std::vector<bool>& loose,
                                       std::size_t row);

// Solutions are refined: residual.hpp sums the unbalanced forces, and corrections with the same factors follow until they
// no longer shrink. So u has the error of its own rounding, whatever stiffness the rigid rows have in the matrix, and
// whatever the order of the rows.
//
// Pins are springs in the matrix only. They make it regular where a motion has no stiffness, and carry nothing in a
// solution whose loads do no work on such motions.

class ConstraintRows {
 public:
  /// k must outlive the object. pins: their stiffness is the structure's own.
  ConstraintRows(const SparseMatrix& k, std::vector<ConstraintRow> rows,
                 const std::vector<Combination>& pins = {});

  /// True if the matrix is positive definite: every motion has stiffness, or a pin.
  [[nodiscard]] bool regular() const { return regular_; }
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] const SparseMatrix& matrix() const { return matrix_; }
  /// Returns u and the forces F, one per row, for loads P and given r. Requires regular().
  [[nodiscard]] std::pair<Vector, Vector> solve(const Vector& load, const Vector& r) const;
  /// solve() without refinement, with the error eps cond(K).
  [[nodiscard]] std::pair<Vector, Vector> solve_once(Vector load, const Vector& r) const;
  /// Corrects u and the forces of the rigid rows until they balance the load up to rounding, and sets those of springs.
  void refine(const Vector& load, const Vector& r, Vector& u, Vector& forces) const;

 private:
  [[nodiscard]] const ConstraintRow& rigid_row(Eigen::Index i) const {
    return rows_[rigid_[static_cast<std::size_t>(i)]];
  }
  [[nodiscard]] std::vector<assembly::LineSpring> springs(const std::vector<Combination>& pins) const;
  [[nodiscard]] Vector response(const Combination& form) const;

  const SparseMatrix* k_;
  std::vector<ConstraintRow> rows_;
  std::vector<assembly::LineSpring> springs_;  // of rows and pins
  SparseMatrix matrix_;
  linear::SymmetricSolver solver_;
  bool regular_;
  std::vector<std::size_t> rigid_;
  Eigen::MatrixXd schur_;
  std::vector<Vector> responses_;
};

/// The structure's own stiffness along the form, as a spring constant.
[[nodiscard]] double structural_stiffness(const SparseMatrix& k, const Combination& form);

struct StaticProblem {
  const SparseMatrix& stiffness;
  const Vector& load;
  const std::vector<Contact>& contacts;
  const assembly::DofMap& map;
  double rigid_stiffness_factor = 1.0;  ///< stiffness of rigid contacts / structural_stiffness()

  [[nodiscard]] int size() const { return static_cast<int>(load.size()); }
  [[nodiscard]] bool is_support(std::size_t k) const { return !contacts[k].normal_force_given(); }
  [[nodiscard]] double normal_stiffness(std::size_t k) const {
    return contacts[k].takes_impulses()
               ? rigid_stiffness_factor * structural_stiffness(stiffness, contacts[k].normal)
               : contacts[k].normal_stiffness;
  }
  [[nodiscard]] double gap(std::size_t k, const Vector& u) const { return contacts[k].gap_at(u); }
  /// K with the springs of the closed contacts; closed[k] is ignored for sliders.
  [[nodiscard]] SparseMatrix matrix(const std::vector<bool>& closed) const;
  /// Load P - sum_closed kn g0 n.
  [[nodiscard]] Vector right_side(const std::vector<bool>& closed) const;
};

// -N of a contact before the motion starts.
//
//   a slider         its given normal force at t = 0
//   other contacts   reaction of the static start, if there is one

/// -N of a contact, force. nullopt if there is no static start and the contact is not a slider.
[[nodiscard]] inline std::optional<double> static_reaction(const Model& model, std::size_t contact) {
  const Contact& c = model.contacts[contact];
  if (c.normal_force_given()) return c.normal_force.value(0.0);
  if (model.static_start && contact < model.statics.reactions.size()) return model.statics.reactions[contact];
  return std::nullopt;
}

}  // namespace signorini::statics
