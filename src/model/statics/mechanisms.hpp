// mechanisms.hpp: motions without stiffness, and the response of a structure to a slip if contacts at their
// limits allow such motions.
//
//   F = S r,    S symmetric,    S (d . x) = 0        r: slip of each row, F: change of the forces on rows
//
// The last equation is valid for all x with K x = 0 and d_j . x = 0 on the rows that are not loose. Solver errors in these
// zeros would act as a stiffness: a load on such a motion would displace the structure by a large amount, in a direction that
// rounding decides.
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
// The strain energy of such a motion is zero up to the rounding of its evaluation (for a zero row, x_i^2 replaces its
// terms, and D_ii = 1). This criterion needs no reference stiffness, and applies to translations and rotations in one
// matrix. The motions are the lowest eigenvectors of D^-1/2 K D^-1/2, D = diag K, computed part by part
// (parts.hpp), so that a motion of one part is exactly zero on the others: small parts by a dense
// decomposition, large ones by inverse subspace iteration.

/// A basis of the null motions of the symmetric matrix K (n x n), as columns; n x 0 if there are none.
/// Directions of negative energy are included, because nothing resists these motions either.
[[nodiscard]] Eigen::MatrixXd null_motions(const SparseMatrix& k);

/// Quick test by the pivots of D^-1/2 K D^-1/2 (one factorisation): false if K certainly has no null motions.
[[nodiscard]] bool may_have_null_motions(const SparseMatrix& k);

// Rigid-body motions in the simplest basis.
//
//   those of  e_x, e_y, theta x (r - centre)  that are in the null space first, then a complement
//
// A null space has no preferred basis: a free body has infinitely many rotations about points. With this
// basis messages name "vertical motion" if the vertical motion belongs to the null space.

/// Another basis of the columns of `motions` (n x m, full rank): horizontal and vertical motion and the rotation about
/// the centre of the nodes, if they belong to the space, then a complement. Unchanged if the space contains no such
/// motion, and in matrix scenes.
[[nodiscard]] Eigen::MatrixXd simple_motions(const Eigen::MatrixXd& motions, const assembly::DofMap& map);

/// simple_motions() for motions that only move the degrees of freedom `dofs`.
[[nodiscard]] Eigen::MatrixXd simple_motions(const Eigen::MatrixXd& motions, const assembly::DofMap& map,
                                             const std::vector<int>& dofs);

/// The matrix S of F = S r (equation at the top of this file), as a function of one slip.
class Mechanisms {
 public:
  /// loose: one entry per row; true for rows that may slip.
  Mechanisms(const SparseMatrix& k, const std::vector<ConstraintRow>& rows, const std::vector<bool>& loose);

  /// Returns u and the forces on all rows for a slip r of one loose row. held: the structure with all rows.
  [[nodiscard]] std::pair<Vector, Vector> response(const ConstraintRows& held, std::size_t row,
                                                   double r) const;

 private:
  [[nodiscard]] Eigen::VectorXd along(const Eigen::VectorXd& x) const { return q_ * (q_.transpose() * x); }

  std::vector<std::size_t> rows_;  // indices of loose rows
  Eigen::VectorXd root_;           // square roots of loose rows' stiffnesses; in these units S has size one
  Eigen::MatrixXd motions_;        // x, n x m
  Eigen::MatrixXd moves_;          // root_ times d . x
  Eigen::MatrixXd q_;              // an orthonormal basis of moves_
};

}  // namespace signorini::statics
