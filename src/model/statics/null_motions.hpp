// null_motions.hpp: motions without stiffness.
//
//   x^T K x <= 32 eps |x|^T |K| |x|
//
// (for a zero row x_i^2 replaces its terms, D_ii = 1), that is, no strain energy beyond the rounding of its evaluation.
// This criterion needs no reference stiffness, and holds for translations and rotations in one matrix. The motions are
// the lowest eigenvectors of D^-1/2 K D^-1/2, D = diag K, computed part by part (parts.hpp), so that a motion of one
// part is exactly zero on the others: small parts by a dense decomposition, large ones by inverse subspace iteration.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// Columns span the null motions of the symmetric matrix K (n x n); n x 0 if there are none. Directions of negative
/// energy are included, since nothing resists them either.
[[nodiscard]] Eigen::MatrixXd null_motions(const SparseMatrix& k);

/// False: there are none, by the pivots of D^-1/2 K D^-1/2; costs one factorisation.
[[nodiscard]] bool may_have_null_motions(const SparseMatrix& k);

}  // namespace signorini
