// driven.hpp: linear structures under polynomials and a sine of time, by matrix exponentials.
//
//   M u'' + C u' + K u = F w,   w' = W w,   w = (1, t, t^2, sin w t, cos w t);   at rest at 0
//   z' = A z,   z = (u, u', w),   z(t) = exp(A t) z(0)
//
// and the matrices of one element in bending. Independent of the program: dense, and no code in common.
#pragma once

#include <Eigen/Core>

#include "base/eigen_dense.hpp"

namespace signorini::tests::driven {

using Matrix = Eigen::MatrixXd;

/// exp(A) by Taylor's series of A / 2^s, squared s times.
inline Matrix exponential(Matrix a) {
  int halvings = 0;
  for (; a.cwiseAbs().rowwise().sum().maxCoeff() > 0.5; ++halvings) a *= 0.5;
  Matrix sum = Matrix::Identity(a.rows(), a.cols()), term = sum;
  for (int k = 1; k < 30; ++k) {
    term = term * a / k;
    sum += term;
  }
  for (; halvings > 0; --halvings) sum = sum * sum;
  return sum;
}

constexpr int one = 0, linear = 1, square = 2, sine = 3, cosine = 4;  // of w

struct Driven {
  Matrix M, C, K, F;  ///< F: n x 5
  double omega;

  [[nodiscard]] Eigen::VectorXd at(double t) const {
    const Eigen::Index n = M.rows(), d = 5;
    Matrix a = Matrix::Zero(2 * n + d, 2 * n + d);
    a.block(0, n, n, n).setIdentity();
    a.block(n, 0, n, n) = -signorini::base::solve_dense(M, K);
    a.block(n, n, n, n) = -signorini::base::solve_dense(M, C);
    a.block(n, 2 * n, n, d) = signorini::base::solve_dense(M, F);
    const Eigen::Index w = 2 * n;
    a(w + linear, w + one) = 1.0;
    a(w + square, w + linear) = 2.0;
    a(w + sine, w + cosine) = omega;
    a(w + cosine, w + sine) = -omega;
    Eigen::VectorXd z = Eigen::VectorXd::Zero(2 * n + d);
    z[w + one] = z[w + cosine] = 1.0;
    return (exponential(a * t) * z).head(n);
  }
};

/// Bending of one element: v and rotation at both ends.
inline Eigen::Matrix4d bending(double ei, double l) {
  Eigen::Matrix4d k;
  k << 12, 6 * l, -12, 6 * l, 6 * l, 4 * l * l, -6 * l, 2 * l * l, -12, -6 * l, 12, -6 * l, 6 * l, 2 * l * l,
      -6 * l, 4 * l * l;
  return k * (ei / (l * l * l));
}
inline Eigen::Matrix4d inertia(double mass, double l) {
  Eigen::Matrix4d m;
  m << 156, 22 * l, 54, -13 * l, 22 * l, 4 * l * l, 13 * l, -3 * l * l, 54, 13 * l, 156, -22 * l, -13 * l,
      -3 * l * l, -22 * l, 4 * l * l;
  return m * (mass * l / 420.0);
}

}  // namespace signorini::tests::driven
