// held_rows.hpp: a structure with the constraint rows that are in force.
//
//   K u + sum_j d_j F_j = P,    d_j . u - c_j F_j = r_j        c_j = 0: rigid
//
// Rows with a compliance are springs in the matrix. Rigid rows are added to it with the structure's own stiffness and
// enforced by multipliers (a dense Schur complement, with one unknown per rigid row).
#pragma once

#include <utility>
#include <vector>

#include "model/assembly/springs.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// d . u - c F = r: an active constraint row; F is the force along -d.
struct HeldRow {
  Combination form;
  double stiffness = 0.0;  ///< 1 / c; for a rigid row the structure's own, which does not affect the solution
  bool rigid = false;
};

/// True if rigid rows that are not loose also prevent the motion along this row. Its force then is not unique.
[[nodiscard]] bool held_besides(const std::vector<HeldRow>& rows, const std::vector<bool>& loose,
                                std::size_t row);

class HeldRows {
 public:
  HeldRows(const SparseMatrix& k, std::vector<HeldRow> rows);

  /// True if the matrix is positive definite: there is no unconstrained motion.
  [[nodiscard]] bool regular() const { return regular_; }
  /// Number of rows.
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] const SparseMatrix& matrix() const { return matrix_; }
  /// u and the forces F, one per row, for loads and for given r. Requires regular().
  [[nodiscard]] std::pair<Vector, Vector> solve(Vector load, const Vector& r) const;

 private:
  [[nodiscard]] const HeldRow& rigid_row(Eigen::Index i) const {
    return rows_[rigid_[static_cast<std::size_t>(i)]];
  }
  [[nodiscard]] std::vector<LineSpring> springs() const;

  std::vector<HeldRow> rows_;
  SparseMatrix matrix_;
  SymmetricSolver solver_;
  bool regular_;
  std::vector<std::size_t> rigid_;
  Eigen::MatrixXd schur_;
  std::vector<Vector> answers_;
};

}  // namespace signorini
