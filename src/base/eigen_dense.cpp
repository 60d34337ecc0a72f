#include "base/eigen_dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

namespace signorini::base {
namespace {

Eigen::VectorXd values_of(const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>& solver) {
  if (solver.info() == Eigen::Success) return solver.eigenvalues();
  return Eigen::VectorXd::Constant(solver.eigenvalues().size(), std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

EigenPairs symmetric_eigen(const Eigen::MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(a);
  return {values_of(solver), solver.eigenvectors()};
}

Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& a) {
  return values_of(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(a, Eigen::EigenvaluesOnly));
}

namespace {

/// Reduction of A x = mu B x to C y = mu y: B = D L L^T D with D = diag(B)^1/2, C = (D L)^-1 A (D L)^-T. B is
/// scaled to a unit diagonal because translations and rotations have different units.
struct Reduced {
  Eigen::VectorXd s;  ///< 1 / D; empty if B is not positive definite
  Eigen::LLT<Eigen::MatrixXd> llt;
  Eigen::MatrixXd c;

  Reduced(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    const Eigen::VectorXd diagonal = b.diagonal();
    if (diagonal.size() == 0 || diagonal.minCoeff() <= 0.0) return;
    const Eigen::VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
    llt.compute(scale.asDiagonal() * b * scale.asDiagonal());
    if (llt.info() != Eigen::Success) return;
    s = scale;
    c = s.asDiagonal() * a * s.asDiagonal();
    llt.matrixL().solveInPlace(c);
    c.transposeInPlace();
    llt.matrixL().solveInPlace(c);
  }
};

}  // namespace

Eigen::VectorXd generalized_eigenvalues(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const Reduced reduced(a, b);
  if (reduced.s.size() == 0) return {};
  return symmetric_eigenvalues(reduced.c);
}

EigenPairs generalized_eigen(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const Reduced reduced(a, b);
  if (reduced.s.size() == 0) return {};
  EigenPairs pairs = symmetric_eigen(reduced.c);
  reduced.llt.matrixU().solveInPlace(pairs.vectors);
  pairs.vectors = (reduced.s.asDiagonal() * pairs.vectors).eval();
  return pairs;
}

Eigen::MatrixXcd complex_product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) { return a * b; }

Eigen::VectorXcd general_eigenvalues(const Eigen::MatrixXd& a) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(a, false).eigenvalues();
}

std::optional<EigenPairs> real_eigen(const Eigen::MatrixXd& a) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(a);
  if (solver.info() != Eigen::Success || !solver.eigenvalues().imag().isZero(0.0)) return std::nullopt;
  return EigenPairs{solver.eigenvalues().real(), solver.eigenvectors().real()};
}

Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& a) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(a);
  return qr.householderQ() * Eigen::MatrixXd::Identity(a.rows(), a.cols());
}

Eigen::MatrixXd orthogonal_complement(const Eigen::MatrixXd& a) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a);
  const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(a.rows(), a.rows());
  return q.rightCols(a.rows() - qr.rank());
}

int rank(const Eigen::MatrixXd& a) {
  return a.size() == 0 ? 0 : static_cast<int>(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(a).rank());
}

Eigen::MatrixXd solve_dense(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  if (a.size() == 0) return b;  // no unknowns; a decomposition needs at least one
  return a.fullPivLu().solve(b);
}

Eigen::VectorXd particular_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.fullPivLu().solve(b);
}

std::optional<Eigen::VectorXd> solve_regular(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(a);
  if (!lu.isInvertible()) return std::nullopt;
  return lu.solve(b);
}

/// Inverse iteration, x <- A^-1 A^-T x. Since A may be singular, a small diagonal matrix is added before the factorisation.
Eigen::MatrixXd smallest_singular_vectors(const Eigen::MatrixXd& a, Eigen::Index count) {
  constexpr int rounds = 4;
  const Eigen::Index n = a.rows();
  const double tiny =
      std::numeric_limits<double>::epsilon() * (a.size() > 0 ? a.cwiseAbs().maxCoeff() : 0.0) +
      std::numeric_limits<double>::min();
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(a + tiny * Eigen::MatrixXd::Identity(n, n));
  Eigen::MatrixXd x(n, count);
  for (Eigen::Index j = 0; j < count; ++j)
    for (Eigen::Index i = 0; i < n; ++i) x(i, j) = std::cos(static_cast<double>(i * (2 * j + 1) + j));
  for (int k = 0; k < rounds; ++k) {
    x = orthonormal(lu.transpose().solve(x));
    x = orthonormal(lu.solve(x));
  }
  return x;
}

Eigen::VectorXd singular_values(const Eigen::MatrixXd& a) {
  return Eigen::JacobiSVD<Eigen::MatrixXd>(a).singularValues();
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

template <class Svd>
static Eigen::VectorXd truncated_solution(Svd svd, const Eigen::VectorXd& b, double least, double size) {
  const double greatest = svd.singularValues().size() > 0 ? svd.singularValues()[0] : 0.0;
  if (!(greatest > least * size)) return Eigen::VectorXd::Zero(svd.cols());
  svd.setThreshold(least * std::max(1.0, size / greatest));
  return svd.solve(b);
}

Eigen::VectorXd min_norm_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, double least,
                                  double size) {
  // Number of columns above which the divide-and-conquer method costs less than Jacobi rotations.
  constexpr Eigen::Index min_divide_columns = 48;
  constexpr unsigned both = Eigen::ComputeThinU | Eigen::ComputeThinV;
  return a.cols() < min_divide_columns
             ? truncated_solution(Eigen::JacobiSVD<Eigen::MatrixXd>(a, both), b, least, size)
             : truncated_solution(Eigen::BDCSVD<Eigen::MatrixXd>(a, both), b, least, size);
}

Eigen::VectorXd combination_of_columns(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a) {
  return a.completeOrthogonalDecomposition().pseudoInverse();
}

}  // namespace signorini::base
