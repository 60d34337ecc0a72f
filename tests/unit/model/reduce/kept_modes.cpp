#include "model/reduce/kept_modes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace signorini::tests::kept {
namespace {

SparseMatrix sparse(const Eigen::MatrixXd& a) { return a.sparseView(); }

/// n unit masses between two walls, springs k.
SparseMatrix chain(int n, double k) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    a(i, i) = 2.0 * k;
    if (i + 1 < n) a(i, i + 1) = a(i + 1, i) = -k;
  }
  return sparse(a);
}

}  // namespace

TEST_SUITE_BEGIN("unit/model/reduce/kept_modes");

TEST_CASE("modes of a chain up to a cutoff, and what the others answer, in closed form") {
  const int n = 11;
  const double k = 400.0;
  const SparseMatrix stiffness = chain(n, k), mass = sparse(Eigen::MatrixXd::Identity(n, n));
  const auto omega = [&](int j) { return 2.0 * std::sqrt(k) * std::sin(0.5 * M_PI * j / (n + 1)); };
  const reduce::KeptModes modes =
      reduce::modes_up_to(0.5 * (omega(4) + omega(5)), mass, stiffness, Eigen::MatrixXd(n, 0));
  REQUIRE(modes.squares.size() == 4);
  CHECK(modes.truncated_modes == n - 4);
  CHECK(modes.free == 0);
  CHECK(modes.first_truncated == doctest::Approx(omega(5)).epsilon(1e-12));
  for (int j = 0; j < 4; ++j) {
    CHECK(std::sqrt(modes.squares[j]) == doctest::Approx(omega(j + 1)).epsilon(1e-12));
    for (int i = 0; i < n; ++i)
      CHECK(std::abs(modes.shapes(i, j)) ==
            doctest::Approx(std::abs(std::sqrt(2.0 / (n + 1)) * std::sin(M_PI * (j + 1) * (i + 1) / (n + 1))))
                .epsilon(1e-10));
  }
  Vector f = Vector::Zero(n);
  f[2] = 3.0;
  f[8] = -1.0;
  Vector expected = Vector::Zero(n);
  for (int j = 5; j <= n; ++j) {
    Vector shape(n);
    for (int i = 0; i < n; ++i) shape[i] = std::sqrt(2.0 / (n + 1)) * std::sin(M_PI * j * (i + 1) / (n + 1));
    expected += shape * shape.dot(f) / (omega(j) * omega(j));
  }
  CHECK((reduce::ResidualFlexibility(mass, stiffness, modes).response(f) - expected).norm() <
        1e-13 * expected.norm());
}

TEST_CASE("a decomposition that fails is no structure without modes") {
  Eigen::MatrixXd same = Eigen::MatrixXd::Identity(5, 5);
  same(0, 1) = same(1, 0) = 1.0;  // two masses that only move as one
  CHECK_THROWS_WITH_AS(reduce::modes_up_to(1.0, sparse(same), chain(5, 1.0), Eigen::MatrixXd(5, 0)),
                       "the modes of the structure cannot be computed", reduce::NotReducible);
}

TEST_CASE("modes that cannot be computed are refused as that") {
  SparseMatrix stiffness = chain(5, 1.0);
  const SparseMatrix mass = sparse(Eigen::MatrixXd::Identity(5, 5));
  stiffness.coeffRef(2, 2) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH_AS(reduce::modes_up_to(1.0, mass, stiffness, Eigen::MatrixXd(5, 0)),
                       "the modes of the structure cannot be computed", reduce::NotReducible);
  // A mass matrix without a square root.
  SparseMatrix indefinite = mass;
  indefinite.coeffRef(0, 1) = indefinite.coeffRef(1, 0) = 2.0;
  Eigen::MatrixXd free = Eigen::MatrixXd::Zero(5, 1);
  free(4, 0) = 1.0;
  CHECK_THROWS_WITH_AS(reduce::modes_up_to(1.0, indefinite, chain(5, 1.0), free),
                       "the modes of the structure cannot be computed", reduce::NotReducible);
}

TEST_SUITE_END();

}  // namespace signorini::tests::kept
