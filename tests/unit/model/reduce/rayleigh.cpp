// Damping matrices that are sums of mass and stiffness.
#include "model/reduce/kept_modes.hpp"

#include <doctest/doctest.h>

#include "unit/model/scenes.hpp"

using namespace signorini;

namespace {

using Matrix = std::vector<std::vector<double>>;

const Matrix chain_mass = {{2.0, 0.3, 0.0}, {0.3, 1.5, 0.1}, {0.0, 0.1, 0.7}};
const Matrix chain_stiffness = {{900.0, -400.0, 0.0}, {-400.0, 700.0, -300.0}, {0.0, -300.0, 300.0}};

Matrix sum_of(double alpha, double beta) {
  Matrix rows = chain_mass;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) rows[i][j] = alpha * chain_mass[i][j] + beta * chain_stiffness[i][j];
  return rows;
}

SparseMatrix sparse(const Matrix& rows) {
  Eigen::MatrixXd full(3, 3);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) full(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  return full.sparseView();
}

Scene chain_with(const Matrix& damping) {
  Scene scene = test::matrices(chain_mass, damping, chain_stiffness);
  ContactSpec contact;
  contact.name = "c";
  contact.law = Law::compliant;
  contact.normal_stiffness = 500.0;
  contact.normal = Direction{};
  contact.normal->dofs = {{scene.matrices->dofs[2], 1.0}};
  contact.gap = 0.01;
  scene.contacts = {contact};
  scene.reduction = ReductionSpec{15.0, {}, {}, {scene.file, 1, 1}};
  return scene;
}

}  // namespace

TEST_SUITE_BEGIN("unit/model/reduce/rayleigh");

TEST_CASE("factors of sums come back, with and without both parts; a dashpot beside them is none") {
  const SparseMatrix M = sparse(chain_mass), K = sparse(chain_stiffness);
  const double cases[][2] = {{0.3, 2e-4}, {10.0, 0.0}, {0.0, 1e-3}, {1e-6, 0.01}};
  for (const auto& [alpha, beta] : cases) {
    const auto f = reduce::rayleigh_factors(sparse(sum_of(alpha, beta)), M, K);
    REQUIRE(f);
    CHECK(f->alpha == doctest::Approx(alpha).epsilon(1e-7));
    CHECK(f->beta == doctest::Approx(beta).epsilon(1e-10));
  }
  Matrix with_dashpot = sum_of(0.3, 2e-4);
  with_dashpot[1][1] += 1e-6;
  CHECK_FALSE(reduce::rayleigh_factors(sparse(with_dashpot), M, K));
  CHECK_FALSE(reduce::rayleigh_factors(sparse(sum_of(-0.3, 2e-4)), M, K));
  CHECK_FALSE(reduce::rayleigh_factors(SparseMatrix(3, 3), M, K));
}

TEST_CASE("a reduced model damps its modes by the factors, and no static shape") {
  const Model model = build_model(chain_with(sum_of(10.0, 0.0)));
  REQUIRE(model.reduction);
  REQUIRE(model.reduction->massless_shapes > 0);
  CHECK(model.alpha == doctest::Approx(10.0).epsilon(1e-12));
  const Eigen::MatrixXd rest = Eigen::MatrixXd(model.damping) - 10.0 * Eigen::MatrixXd(model.mass);
  CHECK(rest.cwiseAbs().maxCoeff() <= 1e-12 * Eigen::MatrixXd(model.mass).maxCoeff());
  Matrix with_dashpot = sum_of(10.0, 0.0);
  with_dashpot[2][2] += 0.5;
  const Model other = build_model(chain_with(with_dashpot));
  CHECK(other.alpha == 0.0);
  CHECK(Eigen::MatrixXd(other.damping).cwiseAbs().maxCoeff() > 0.0);
}

TEST_SUITE_END();
