// held_rows.hpp: a structure on rows that hold it, as many as are in force.
//
//   K u + sum_j d_j F_j = P,    d_j . u - c_j F_j = r_j        c_j = 0: rigid
//
// Rows with a compliance are springs in the matrix; rigid ones are added to it with the structure's own
// stiffness and held by multipliers (a dense Schur complement, as many unknowns as there are rigid rows).
#pragma once

#include <utility>
#include <vector>

#include "model/assembly/springs.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// d . u - c F = r: a row that is in force, F the force along -d.
struct HeldRow {
  Combination form;
  double stiffness = 0.0;  ///< 1 / c; of a rigid row the structure's own, which changes nothing
  bool rigid = false;
};

/// Do rigid rows that are not loose prevent the motion along this one, too? Its force is not unique then.
[[nodiscard]] bool held_besides(const std::vector<HeldRow>& rows, const std::vector<bool>& loose,
                                std::size_t row);

class HeldRows {
 public:
  HeldRows(const SparseMatrix& k, std::vector<HeldRow> rows);

  /// Positive definite: what is held stays where it is.
  [[nodiscard]] bool regular() const { return regular_; }
  /// Of rows.
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] const SparseMatrix& matrix() const { return matrix_; }
  /// u and the forces F, one a row, for loads and for given r. Only where regular().
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
