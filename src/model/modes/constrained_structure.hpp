// constrained_structure.hpp: static response of a structure with constraints from contacts.
//
//   K u + T r = b,   T^T u = 0
//
// K: n x n, springs included; u = 0 is the only motion with K u = 0 and T^T u = 0. T: n x m, fixed forms. Springs along T
// make K regular and do not change u.
#pragma once

#include <vector>

#include "linear/sparse_cholesky.hpp"
#include "model/assembly/springs.hpp"

namespace signorini::modes {

class ConstrainedStructure {
 public:
  ConstrainedStructure(const SparseMatrix& k, const std::vector<Combination>& fixed);

  [[nodiscard]] Vector solve(const Vector& b) const;
  /// True if K with the springs along T is positive definite; K is then positive definite on motions with T^T u = 0.
  [[nodiscard]] bool definite() const { return solver_.ok() && solver_.smallest_pivot() > 0.0; }

 private:
  /// Constraints of one part of the structure: t: T for the forms on this part; correction = K^-1 T (T^T K^-1 T)^-1.
  struct ConstraintBlock {
    std::vector<int> dofs;
    Eigen::MatrixXd t, correction;
  };
  linear::SymmetricSolver solver_;
  std::vector<ConstraintBlock> constraint_blocks_;
};

/// Returns K plus springs along the forms; each spring has the stiffness of the structure along its form.
[[nodiscard]] SparseMatrix with_constraint_springs(const SparseMatrix& k,
                                                   const std::vector<Combination>& forms);

/// Q^T A Q for symmetric A. Entries below the rounding error of their terms are omitted.
[[nodiscard]] SparseMatrix restricted(const SparseMatrix& a, const Eigen::MatrixXd& q);

/// Matrix with the forms as columns, n x m.
[[nodiscard]] Eigen::MatrixXd form_columns(const std::vector<Combination>& forms, int n);

}  // namespace signorini::modes
