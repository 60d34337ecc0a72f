// loose_motions.hpp: how a held structure answers to a slip, where contacts at their limits leave it motions that
// nothing resists.
//
//   F = S r,    S symmetric,    S (d . x) = 0        r: by how much each row slips, F: change of the forces on rows
//
// for all x with K x = 0 and d_j . x = 0 on the rows that stay. What solves leave of these zeros would be a stiffness:
// a load that nothing resists would move the structure by its inverse, and the sign of rounding would decide.
#pragma once

#include <utility>

#include "model/statics/held_rows.hpp"

namespace signorini {

class LooseMotions {
 public:
  /// loose: one a row; those that may slip.
  LooseMotions(const SparseMatrix& k, const std::vector<HeldRow>& rows, const std::vector<bool>& loose);

  /// u and the forces on all rows for a slip of one loose row by r.
  [[nodiscard]] std::pair<Vector, Vector> answer(const HeldRows& held, std::size_t row, double r) const;

 private:
  [[nodiscard]] Eigen::VectorXd along(const Eigen::VectorXd& x) const { return q_ * (q_.transpose() * x); }

  std::vector<std::size_t> rows_;  // that are loose
  Eigen::VectorXd root_;           // of their stiffnesses, in whose units S is of size one
  Eigen::MatrixXd motions_;        // x, n x m
  Eigen::MatrixXd moves_;          // root (d . x)
  Eigen::MatrixXd q_;              // an orthonormal basis of these
};

}  // namespace signorini
