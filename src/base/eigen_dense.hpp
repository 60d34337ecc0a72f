// eigen_dense.hpp: dense matrix decompositions and complex products, compiled in one file to save compile time.
//
//   A x = mu x,    A x = mu B x,    A = Q R,    A = P^T L U Q^T,    A = U S V^T
//
// Eigenvalues of symmetric matrices are in ascending order.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace signorini::base {

struct EigenPairs {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< eigenvectors as columns, orthonormal (with respect to B if there is a B)
};

/// Eigenpairs of a symmetric matrix; the values are NaN if the decomposition did not converge.
[[nodiscard]] EigenPairs symmetric_eigen(const Eigen::MatrixXd& a);
[[nodiscard]] Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& a);

/// Eigenvalues of A x = mu B x, A and B symmetric; empty if B is not positive definite.
[[nodiscard]] Eigen::VectorXd generalized_eigenvalues(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// Eigenpairs of A x = mu B x, normalised to x^T B x = 1; both members are empty if B is not positive definite.
[[nodiscard]] EigenPairs generalized_eigen(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// Product a b. Compiled in one file, because the product adds seconds to the compile time of each file that contains it.
[[nodiscard]] Eigen::MatrixXcd complex_product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b);

/// Eigenvalues of a general square matrix, unsorted.
[[nodiscard]] Eigen::VectorXcd general_eigenvalues(const Eigen::MatrixXd& a);

/// Eigenpairs of a general square matrix, columns of length 1; nullopt if an eigenvalue is complex.
[[nodiscard]] std::optional<EigenPairs> real_eigen(const Eigen::MatrixXd& a);

/// Orthonormal columns (n x m) that span the columns of a. a: n x m, m <= n, full rank.
[[nodiscard]] Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& a);

/// Orthonormal basis (n x (n - rank)) of the vectors x with A^T x = 0; a: n x m.
[[nodiscard]] Eigen::MatrixXd orthogonal_complement(const Eigen::MatrixXd& a);

/// Rank of the matrix a (n x m, n and m may be 0).
[[nodiscard]] int rank(const Eigen::MatrixXd& a);

/// A^-1 b, with full pivoting; A: general, square and regular.
[[nodiscard]] Eigen::MatrixXd solve_dense(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// One solution x of A x = b for a square A that may be singular. If there is no solution, A x differs from b.
[[nodiscard]] Eigen::VectorXd particular_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
/// Solution x of A x = b; nullopt if A is singular up to rounding.
[[nodiscard]] std::optional<Eigen::VectorXd> solve_regular(const Eigen::MatrixXd& a,
                                                           const Eigen::VectorXd& b);

/// Right singular vectors of the `count` smallest singular values, n x count, orthonormal. These singular values must be well
/// below all larger ones.
[[nodiscard]] Eigen::MatrixXd smallest_singular_vectors(const Eigen::MatrixXd& a, Eigen::Index count);

/// Singular values, descending; A: n x m.
[[nodiscard]] Eigen::VectorXd singular_values(const Eigen::MatrixXd& a);

/// Minimiser x of |A x - b| with the least norm; A: n x m, any rank.
[[nodiscard]] Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
[[nodiscard]] Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// Minimiser x of |A x - b| with the least norm. A singular value of A is treated as zero if it is below `least` times the
/// largest one, or below `least` times `size`. size: magnitude of the terms if A is a difference of terms.
[[nodiscard]] Eigen::VectorXd min_norm_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                                double least, double size = 0.0);

/// One minimiser x of |A x - b|, in which linearly dependent columns of A have the factor zero; A: n x m, m <= n.
[[nodiscard]] Eigen::VectorXd combination_of_columns(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// Pseudo-inverse (m x n) of A (n x m, any rank).
[[nodiscard]] Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a);

}  // namespace signorini::base
