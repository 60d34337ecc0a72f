#include "base/eigen_dense.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace signorini;

namespace {

/// Orthogonal, n x n.
Eigen::MatrixXd turned(Eigen::Index n, double by) {
  Eigen::MatrixXd a(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) a(i, j) = std::sin(by * static_cast<double>((i + 1) * (j + 2)));
  return base::orthonormal(a);
}

}  // namespace

TEST_SUITE_BEGIN("unit/base/eigen_dense");

TEST_CASE("directions of the least singular values, of matrices that are singular or nearly") {
  for (const Eigen::Index n : {1, 3, 17})
    for (const double least : {0.0, 1e-13}) {
      CAPTURE(n);
      CAPTURE(least);
      const Eigen::Index count = n == 1 ? 1 : 2;
      const Eigen::MatrixXd u = turned(n, 1.3), v = turned(n, 0.7);
      Eigen::VectorXd s(n);
      for (Eigen::Index i = 0; i < n; ++i)
        s[i] = i < count ? least : (i % 2 == 0 ? 1.0 : 1e-3) * (1.0 + static_cast<double>(i));
      const Eigen::MatrixXd found =
          base::smallest_singular_vectors(u * s.asDiagonal() * v.transpose(), count);
      REQUIRE(found.cols() == count);
      CHECK((found.transpose() * found - Eigen::MatrixXd::Identity(count, count)).norm() <= 1e-14);
      CHECK((found - v.leftCols(count) * (v.leftCols(count).transpose() * found)).norm() <= 1e-11);
    }
}

TEST_SUITE_END();
