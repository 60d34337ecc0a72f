// null_motions.hpp: the motions that a stiffness does not resist.
//
//   x^T K x <= 32 eps |x|^T |K| |x|
//
// and of a row of zeros x_i^2 in place of its terms, D_ii = 1;
// that is, no strain energy beyond the roundoff of evaluating it; this needs no stiffness to compare
// with, and holds for translations and rotations in one matrix. Found as the lowest eigenvectors of
// D^-1/2 K D^-1/2, D = diag K, part by part (parts.hpp), so that a motion of one part is exactly none of the others: of
// small parts by a dense decomposition, of large ones by inverse subspace iteration.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// Columns span the null motions of the symmetric matrix K (n x n); n x 0 when there are none.
/// Directions of negative energy count as null: nothing resists them either.
[[nodiscard]] Eigen::MatrixXd null_motions(const SparseMatrix& k);

/// False: it has none, by the pivots of D^-1/2 K D^-1/2, at the cost of one factorisation.
[[nodiscard]] bool may_have_null_motions(const SparseMatrix& k);

}  // namespace signorini
