// lowest_modes.hpp: a given number of the lowest modes of a large structure, repeated ones included.
//
//   K phi = omega^2 M phi,   Phi_free^T M phi = 0
//   A = (K + s M)^-1 M,   A phi = phi / (omega^2 + s)
//
// One Lanczos run (Spectra) of the size that is needed. A single start vector sees one motion of each
// repeated frequency; what is missing is found by block Krylov iteration M-orthogonal to what is known (Golub
// and Van Loan, Matrix Computations, section 10.3.6), with blocks as wide as the number that is missing.
#pragma once

#include "base/eigen_dense.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// x less its part along the M-orthonormal columns of the basis, twice for the sake of rounding.
void take_out(const Eigen::MatrixXd& basis, const SparseMatrix& mass, Eigen::MatrixXd& x);

/// The `below` lowest modes that are not free, and, last, the first one above them: omega^2 ascending, and
/// M-orthonormal shapes, n x (below + 1). `limit` (omega^2) separates both. Fewer columns where they were not
/// found. `free`: M-orthonormal free motions, n x f, all of them; `shift` = s, K + s M positive definite.
[[nodiscard]] EigenPairs lowest_modes(int below, double limit, const SparseMatrix& mass,
                                      const SparseMatrix& stiffness, const Eigen::MatrixXd& free,
                                      double shift);

}  // namespace signorini
