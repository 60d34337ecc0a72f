// The kernels of a step: products with M, C and K, solves with packed factors.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <random>

#include "linear/klu.hpp"
#include "linear/system_matrices.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

/// Beams with Rayleigh damping, and one dashpot that is not of that form.
Model damped_frame(const std::string& damping, const std::string& more) {
  return build_model(
      parse_scene("schema = 1\nunits = { force = \"kN\", mass = \"t\", length = \"m\", time = \"s\" }\n"
                  "[run]\nt_end = 1.0\ninitial = { B = { ux = 0.0 } }\n[damping]\n" +
                      damping +
                      "[sections.s]\nEA = 9.0e6\nEI = 2.0e6\nmass_per_length = 0.4\n"
                      "[nodes]\nA = [0.0, 0.0]\nB = [1.0, 2.0]\n"
                      "[[members]]\nnodes = [\"A\", \"B\"]\nsection = \"s\"\nelements = 4\n" +
                      more,
                  "frame"));
}

void check_product(const Model& model) {
  const linear::SystemMatrices structure(model);
  linear::StructuralForces product(model, structure);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Vector a(model.size()), v(model.size()), u(model.size()), r(model.size());
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    a[i] = uniform(random), v[i] = uniform(random), u[i] = uniform(random);
    product.put(static_cast<std::size_t>(i), a[i], v[i], u[i]);
  }
  product.apply(r.data());
  const Vector expected = model.mass * a + model.damping * v + model.stiffness * u;
  const double size = expected.cwiseAbs().maxCoeff();
  CHECK((r - expected).cwiseAbs().maxCoeff() <= 1e-14 * size);
  CHECK(structure.damping_power(v.data()) == doctest::Approx(v.dot(model.damping * v)).epsilon(1e-13));
}

/// Solves with random right sides against Eigen's, factored and refactored.
void check_solves(const Eigen::MatrixXd& dense) {
  const SparseMatrix a = dense.sparseView();
  const std::vector<std::int64_t> start(a.outerIndexPtr(), a.outerIndexPtr() + a.cols() + 1),
      row(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros());
  std::vector<double> values(a.valuePtr(), a.valuePtr() + a.nonZeros());
  linear::Klu klu(start, row);
  for (const double factor : {1.0, 3.0}) {
    for (double& value : values) value *= factor;
    REQUIRE((factor == 1.0 ? klu.factor(values) : klu.refactor(values)));
    Vector x = Vector::LinSpaced(dense.rows(), 1.0, 2.0);
    const Vector b = x;
    klu.solve(x.data());
    CHECK((factor * dense * x - b).cwiseAbs().maxCoeff() <=
          1e-13 * factor * dense.cwiseAbs().maxCoeff() * x.cwiseAbs().maxCoeff());
  }
}

}  // namespace

TEST_SUITE_BEGIN("unit/linear/linear_kernels");

TEST_CASE("M a + C v + K u in one pass, whatever C is made of") {
  SUBCASE("no damping") { check_product(damped_frame("alpha = 0.0\n", "")); }
  SUBCASE("Rayleigh damping") { check_product(damped_frame("alpha = 3.0\nbeta = 1e-4\n", "")); }
  SUBCASE("a dashpot beside it") {
    check_product(damped_frame("alpha = 3.0\nbeta = 1e-4\n",
                               "[[springs]]\nnode = \"B\"\ndirection = [0.6, 0.8]\nstiffness = 10.0\n"
                               "damping = 250.0\n"));
  }
}

TEST_CASE("packed factors solve what KLU has factored") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  SUBCASE("a full matrix that needs pivots") {
    Eigen::MatrixXd a(7, 7);
    for (Eigen::Index i = 0; i < a.size(); ++i) a.data()[i] = uniform(random);
    a.diagonal().setZero();
    check_solves(a);
  }
  SUBCASE("blocks of several sizes with entries above them") {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(9, 9);
    for (const auto& [begin, size] : {std::pair{0, 3}, {3, 1}, {4, 1}, {5, 4}})
      for (int i = 0; i < size; ++i)
        for (int j = 0; j < size; ++j) a(begin + i, begin + j) = uniform(random) + (i == j ? 2.0 : 0.0);
    a(0, 4) = 0.7;
    a(1, 8) = -0.4;
    a(3, 5) = 1.3;
    a(4, 6) = 0.2;
    Eigen::PermutationMatrix<9> mix;
    mix.indices() << 4, 7, 1, 0, 8, 3, 6, 2, 5;
    check_solves(mix * a * mix.transpose());
  }
  SUBCASE("a band with rows of very different sizes") {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(40, 40);
    for (Eigen::Index i = 0; i < 40; ++i)
      for (Eigen::Index j = std::max<Eigen::Index>(0, i - 3); j < std::min<Eigen::Index>(40, i + 4); ++j)
        a(i, j) = (uniform(random) + (i == j ? 5.0 : 0.0)) * (i % 3 == 0 ? 1e6 : 1.0);
    check_solves(a);
  }
}
