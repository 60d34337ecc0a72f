// All modes of structures whose contacts are open.
#include "engine/exact/modal/unconstrained_modes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "signorini/scene.hpp"

using namespace signorini;

namespace {

/// n unit masses in a row, springs k between neighbours; a ring where `closed`.
SparseMatrix chain(int n, double k, bool closed) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto spring = [&](int i, int j) {
    entries.emplace_back(i, i, k);
    entries.emplace_back(j, j, k);
    entries.emplace_back(i, j, -k);
    entries.emplace_back(j, i, -k);
  };
  for (int i = 0; i + 1 < n; ++i) spring(i, i + 1);
  if (closed) spring(n - 1, 0);
  SparseMatrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

SparseMatrix identity(int n) {
  SparseMatrix matrix(n, n);
  matrix.setIdentity();
  return matrix;
}

double off_diagonal(const modal::UnconstrainedModes& modes, const SparseMatrix& stiffness) {
  Eigen::MatrixXd k = modes.shapes.transpose() * (stiffness * modes.shapes);
  k.diagonal() -= modes.omega_squared;
  return k.cwiseAbs().maxCoeff();
}

double off_identity(const modal::UnconstrainedModes& modes, const SparseMatrix& mass) {
  Eigen::MatrixXd m = modes.shapes.transpose() * (mass * modes.shapes);
  m.diagonal().array() -= 1.0;
  return m.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_SUITE_BEGIN("unit/engine/exact/modal/unconstrained_modes");

TEST_CASE("open modes: a free chain") {
  const int n = 24;
  const SparseMatrix k = chain(n, 1e4, false);
  const modal::UnconstrainedModes modes = modal::unconstrained_modes(identity(n), k);
  REQUIRE(modes.failure == "");
  CHECK(modes.free == 1);
  CHECK(off_identity(modes, identity(n)) < 1e-14 * n);
  CHECK(off_diagonal(modes, k) < 1e-14 * n * modes.omega_squared[n - 1]);
  for (int i = 0; i < n; ++i) {
    const double omega = 200.0 * std::sin(std::numbers::pi * 0.5 * i / static_cast<double>(n));
    CHECK(std::sqrt(modes.omega_squared[i]) == doctest::Approx(omega).epsilon(1e-12));
  }
}

TEST_CASE("open modes: a ring, all of whose frequencies are double, is not found, and that is said") {
  CHECK(modal::unconstrained_modes(identity(24), chain(24, 1e4, true)).failure ==
        "the modes that were found are not orthogonal");
}

TEST_CASE("open modes: the pipeline floats freely, all its modes are orthogonal") {
  const Model model = build_model(read_scene(SIGNORINI_MODELS "/pipeline.toml"));
  const modal::UnconstrainedModes modes = modal::unconstrained_modes(model.mass, model.stiffness);
  REQUIRE(modes.failure == "");
  CHECK(modes.free == 3);
  CHECK(off_identity(modes, model.mass) < 1e-13);
  CHECK(off_diagonal(modes, model.stiffness) < 1e-14 * modes.omega_squared[model.size() - 1]);
}

TEST_CASE("open modes: what is not a structure of their kind is named") {
  SparseMatrix k = chain(6, 1.0, false);
  k.coeffRef(0, 0) = -3.0;
  CHECK(modal::unconstrained_modes(identity(6), k).failure ==
        "the stiffness matrix is not positive semidefinite");
  SparseMatrix m = identity(6);
  m.coeffRef(2, 2) = -1.0;
  CHECK(modal::unconstrained_modes(m, chain(6, 1.0, false)).failure ==
        "the mass matrix is not positive definite");
  CHECK(modal::unconstrained_modes(identity(3), SparseMatrix(3, 3)).failure ==
        "the structure has no stiffness");
}
