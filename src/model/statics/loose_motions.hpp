// loose_motions.hpp: response of a constrained structure to a slip, if contacts at their limits leave it motions
// without resistance.
//
//   F = S r,    S symmetric,    S (d . x) = 0        r: slip of each row, F: change of the forces on rows
//
// for all x with K x = 0 and d_j . x = 0 on the remaining rows. Solver errors in these zeros would act as a stiffness:
// a load on such a motion would move the structure by its inverse, with the sign of rounding.
#pragma once

#include <utility>

#include "model/statics/held_rows.hpp"

namespace signorini {

class LooseMotions {
 public:
  /// loose: one entry per row; true for rows that may slip.
  LooseMotions(const SparseMatrix& k, const std::vector<HeldRow>& rows, const std::vector<bool>& loose);

  /// u and the forces on all rows for a slip of one loose row by r.
  [[nodiscard]] std::pair<Vector, Vector> answer(const HeldRows& held, std::size_t row, double r) const;

 private:
  [[nodiscard]] Eigen::VectorXd along(const Eigen::VectorXd& x) const { return q_ * (q_.transpose() * x); }

  std::vector<std::size_t> rows_;  // indices of loose rows
  Eigen::VectorXd root_;           // square roots of their stiffnesses; in these units S has size one
  Eigen::MatrixXd motions_;        // x, n x m
  Eigen::MatrixXd moves_;          // root (d . x)
  Eigen::MatrixXd q_;              // an orthonormal basis of moves_
};

}  // namespace signorini
