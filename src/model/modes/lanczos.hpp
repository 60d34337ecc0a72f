// lanczos.hpp: extreme eigenvalues of operators that are given as matrix-vector products (Spectra).
//
//   A x = mu x,   A: n x n, symmetric, positive semidefinite
//   (K + s M)^-1 M phi = phi / (omega^2 + s)
#pragma once

#include <functional>

#include "base/eigen_dense.hpp"
#include "signorini/model.hpp"

namespace signorini {

using Operator = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// Relative accuracy `tolerance`. Returns the best estimate if the iteration does not converge.
[[nodiscard]] double greatest_eigenvalue(int n, const Operator& apply, double tolerance);

/// The algebraically largest eigenvalues, descending; fewer or none if the iteration does not converge. A single start
/// vector finds each repeated eigenvalue once.
[[nodiscard]] Vector greatest_eigenvalues(int n, int count, const Operator& apply);

/// The `count` lowest modes as far as a single start vector finds them: omega^2 and M-orthonormal shapes, not sorted,
/// from a Krylov space of dimension `width`; none if the iteration does not converge. `inverse`: (K + shift M)^-1.
[[nodiscard]] EigenPairs lowest_by_inverse(int count, int width, const SparseMatrix& mass, double shift,
                                           const Operator& inverse);

}  // namespace signorini
