// lanczos.hpp: extreme eigenvalues of operators that are given as matrix-vector products (Spectra).
//
//   A x = mu x,   A: n x n, symmetric, positive semidefinite
//   (K + s M)^-1 M phi = phi / (omega^2 + s)
#pragma once

#include <functional>

#include "base/eigen_dense.hpp"
#include "signorini/model.hpp"

namespace signorini::modes {

using Operator = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// The largest eigenvalue, with the relative accuracy `tolerance`; the best estimate if the iteration does
/// not converge.
[[nodiscard]] double largest_eigenvalue(int n, const Operator& apply, double tolerance);

/// The algebraically largest eigenvalues, descending; fewer or none if the iteration does not converge. A single start
/// vector finds each repeated eigenvalue once.
[[nodiscard]] Vector largest_eigenvalues(int n, int count, const Operator& apply);

/// The `count` lowest modes, each repeated mode once: omega^2 and M-orthonormal shapes, not sorted, from a Krylov
/// space of dimension `width`; none if the iteration does not converge. `inverse`: (K + shift M)^-1.
[[nodiscard]] base::EigenPairs shift_invert_modes(int count, int width, const SparseMatrix& mass,
                                                  double shift, const Operator& inverse);

// A given number of the lowest modes of a large structure, repeated ones included.
//
//   K phi = omega^2 M phi,   Phi_free^T M phi = 0
//   A = (K + s M)^-1 M,   A phi = phi / (omega^2 + s)
//
// One Lanczos run (Spectra) finds one mode of each repeated frequency. The other modes of this frequency are found by
// block Krylov iteration, M-orthogonal to the known modes (Golub and Van Loan, Matrix Computations, section 10.3.6),
// with blocks as wide as the number of missing modes.

/// Subtracts from x its part along the M-orthonormal columns of the basis; does so twice because of rounding.
void deflate(const Eigen::MatrixXd& basis, const SparseMatrix& mass, Eigen::MatrixXd& x);

/// The `below` lowest modes that are not free motions, and the next mode: omega^2 ascending, and M-orthonormal shapes,
/// n x (below + 1); fewer columns if some were not found. limit: value between omega^2 of the last two of these
/// modes. free: all M-orthonormal free motions, n x f; shift: s, with K + s M positive
/// definite.
[[nodiscard]] base::EigenPairs lowest_modes(int below, double limit, const SparseMatrix& mass,
                                            const SparseMatrix& stiffness, const Eigen::MatrixXd& free,
                                            double shift);

}  // namespace signorini::modes
