// mechanisms.hpp: response of a constrained structure to a slip, if contacts at their limits leave it motions
// without resistance.
//
//   F = S r,    S symmetric,    S (d . x) = 0        r: slip of each row, F: change of the forces on rows
//
// for all x with K x = 0 and d_j . x = 0 on the remaining rows. Solver errors in these zeros would act as a stiffness:
// a load on such a motion would move the structure by its inverse, with the sign of rounding.
#pragma once

#include <utility>
#include <vector>

#include "model/assembly/dofs.hpp"
#include "model/statics/static_system.hpp"
#include "signorini/model.hpp"

namespace signorini::statics {

// Motions without stiffness.
//
//   x^T K x <= 32 eps |x|^T |K| |x|
//
// (for a zero row x_i^2 replaces its terms, D_ii = 1), that is, no strain energy beyond the rounding of its evaluation.
// This criterion needs no reference stiffness, and holds for translations and rotations in one matrix. The motions are
// the lowest eigenvectors of D^-1/2 K D^-1/2, D = diag K, computed part by part (parts.hpp), so that a motion of one
// part is exactly zero on the others: small parts by a dense decomposition, large ones by inverse subspace iteration.

/// Columns span the null motions of the symmetric matrix K (n x n); n x 0 if there are none. Directions of negative
/// energy are included, since nothing resists them either.
[[nodiscard]] Eigen::MatrixXd null_motions(const SparseMatrix& k);

/// False: there are none, by the pivots of D^-1/2 K D^-1/2; costs one factorisation.
[[nodiscard]] bool may_have_null_motions(const SparseMatrix& k);

// Rigid-body motions in the simplest basis.
//
//   span N contains  e_x, e_y, theta x (r - centre)?   these first, then the complement in N
//
// A null space has no preferred basis: a free body has infinitely many rotations about points. Messages shall name
// "vertical motion" if it is one of the motions.

/// Another basis of the columns of `motions` (n x m, full rank): horizontal and vertical motion and the rotation about
/// the centre of the nodes, if they belong to the space, then a complement. Unchanged if the space contains none of
/// them, and in matrix scenes.
[[nodiscard]] Eigen::MatrixXd simple_motions(const Eigen::MatrixXd& motions, const assembly::DofMap& map);

/// Same for motions that only involve these degrees of freedom.
[[nodiscard]] Eigen::MatrixXd simple_motions(const Eigen::MatrixXd& motions, const assembly::DofMap& map,
                                             const std::vector<int>& dofs);

class Mechanisms {
 public:
  /// loose: one entry per row; true for rows that may slip.
  Mechanisms(const SparseMatrix& k, const std::vector<ConstraintRow>& rows, const std::vector<bool>& loose);

  /// u and the forces on all rows for a slip of one loose row by r.
  [[nodiscard]] std::pair<Vector, Vector> response(const ConstraintRows& held, std::size_t row,
                                                   double r) const;

 private:
  [[nodiscard]] Eigen::VectorXd along(const Eigen::VectorXd& x) const { return q_ * (q_.transpose() * x); }

  std::vector<std::size_t> rows_;  // indices of loose rows
  Eigen::VectorXd root_;           // square roots of their stiffnesses; in these units S has size one
  Eigen::MatrixXd motions_;        // x, n x m
  Eigen::MatrixXd moves_;          // root (d . x)
  Eigen::MatrixXd q_;              // an orthonormal basis of moves_
};

}  // namespace signorini::statics
