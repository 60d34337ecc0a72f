// eigen_dense.hpp: dense decompositions and products of complex matrices, compiled once.
//
//   A x = mu x,    A x = mu B x,    A = Q R,    A = P^T L U Q^T,    A = U S V^T
//
// All matrices square and symmetric unless said otherwise; their eigenvalues ascend.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace signorini {

struct EigenPairs {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< columns, orthonormal (in B where there is one)
};

/// Values are no numbers where the decomposition did not converge.
[[nodiscard]] EigenPairs symmetric_eigen(const Eigen::MatrixXd& a);
[[nodiscard]] Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& a);

/// Eigenvalues of A x = mu B x, B positive definite; empty when B is not.
[[nodiscard]] Eigen::VectorXd generalized_eigenvalues(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// The same with eigenvectors, x^T B x = 1; both empty when B is not positive definite.
[[nodiscard]] EigenPairs generalized_eigen(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// a b: each file that writes the product itself takes seconds to compile it.
[[nodiscard]] Eigen::MatrixXcd complex_product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b);

/// Eigenvalues of a square matrix that need not be symmetric, in no order.
[[nodiscard]] Eigen::VectorXcd general_eigenvalues(const Eigen::MatrixXd& a);

/// Eigenpairs of a square matrix that need not be symmetric, columns of length 1; empty where a value is complex.
[[nodiscard]] std::optional<EigenPairs> real_eigen(const Eigen::MatrixXd& a);

/// Orthonormal columns that span those of a (n x m, m <= n, full rank).
[[nodiscard]] Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& a);

/// Orthonormal basis (n x (n - rank)) of the vectors x with A^T x = 0; a: n x m.
[[nodiscard]] Eigen::MatrixXd orthogonal_complement(const Eigen::MatrixXd& a);

/// Of a, n x m, m >= 0.
[[nodiscard]] int rank(const Eigen::MatrixXd& a);

/// A^-1 b by full pivoting; A square, not necessarily symmetric, regular.
[[nodiscard]] Eigen::MatrixXd solve_dense(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// The same; where A is singular, some x, with A x = b if there is one.
[[nodiscard]] Eigen::VectorXd some_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
/// The same; nothing where A is singular to rounding.
[[nodiscard]] std::optional<Eigen::VectorXd> solve_regular(const Eigen::MatrixXd& a,
                                                           const Eigen::VectorXd& b);

/// Right singular vectors of the least `count` singular values, n x count, orthonormal. Those must be well below the others.
[[nodiscard]] Eigen::MatrixXd least_stretched(const Eigen::MatrixXd& a, Eigen::Index count);

/// Descending; A: n x m.
[[nodiscard]] Eigen::VectorXd singular_values(const Eigen::MatrixXd& a);

/// The shortest x with the least |A x - b|; A: n x m of any rank.
[[nodiscard]] Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
[[nodiscard]] Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// The shortest x with the least |A x - b|. Singular values of A below `least` of the greatest are taken as zero, and those below
/// `least` of `size`: that of the terms whose difference A is.
[[nodiscard]] Eigen::VectorXd shortest_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                                double least, double size = 0.0);

/// Some x with the least |A x - b|: what depends on other columns takes no part; A: n x m, m <= n.
[[nodiscard]] Eigen::VectorXd combination_of_columns(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// m x n, for A: n x m of any rank.
[[nodiscard]] Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a);

}  // namespace signorini
