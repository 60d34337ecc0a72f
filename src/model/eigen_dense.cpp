#include "model/eigen_dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace signorini {

EigenPairs symmetric_eigen(const Eigen::MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXd generalized_eigenvalues(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  // Scaled to a unit diagonal of B first: translations and rotations differ by powers of the length.
  const Eigen::VectorXd diagonal = b.diagonal();
  if (diagonal.size() == 0 || diagonal.minCoeff() <= 0.0) return {};
  const Eigen::VectorXd s = diagonal.cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> llt(s.asDiagonal() * b * s.asDiagonal());
  if (llt.info() != Eigen::Success) return {};
  Eigen::MatrixXd c = s.asDiagonal() * a * s.asDiagonal();
  llt.matrixL().solveInPlace(c);
  c.transposeInPlace();
  llt.matrixL().solveInPlace(c);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(c, Eigen::EigenvaluesOnly).eigenvalues();
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

Eigen::MatrixXd solve_dense(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.fullPivLu().solve(b);
}

}  // namespace signorini
