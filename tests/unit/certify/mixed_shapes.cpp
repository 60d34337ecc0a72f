// Shapes of reduced models, off by what roundings of the structure's stiffnesses make of them.
#include <doctest/doctest.h>

#include <cmath>

#include "base/eigen_dense.hpp"
#include "certify/data_perturbation.hpp"
#include "signorini/model.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/certify/mixed_shapes");

namespace {

/// Two stiff pairs of masses on soft springs, the stiff modes left out; a foot and a load on all of them.
const char* const stiff_pairs = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 1.0
initial = { u = [0.3, 0.3, 0.2, 0.2], v = [-0.1, -0.1, 0.4, 0.4] }
[reduction]
cutoff_omega = 1.0e2
[matrices]
dofs = ["a", "b", "c", "d"]
mass = [[1.0, 0.0, 0.0, 0.0], [0.0, 2.0, 0.0, 0.0], [0.0, 0.0, 1.5, 0.0], [0.0, 0.0, 0.0, 1.0]]
stiffness = [[1.000003e6, -1.0e6, 0.0, 0.0], [-1.0e6, 1.000002e6, -2.0, 0.0],
             [0.0, -2.0, 1.000002e6, -1.0e6], [0.0, 0.0, -1.0e6, 1.000001e6]]
[[contacts]]
name = "foot"
law = "compliant"
normal = { a = 0.6, c = 0.8 }
tangent = { b = -0.8, d = 0.6 }
gap = 0.9
normal_stiffness = 300.0
tangential_stiffness = 200.0
friction = 0.4
[[loads]]
direction = { a = 0.3, d = 1.0 }
amplitude = 5.0
history = { type = "harmonic", omega = 3.0 }
)";

Vector of_shapes(const Model& model, const Combination& form) {
  Vector f = Vector::Zero(model.size());
  form.add_to(f, 1.0);
  return f;
}

}  // namespace

TEST_CASE("two soft shapes of stiff parts turn by roundings of these over what their frequencies are apart") {
  const Model model = build_model(parse_scene(stiff_pairs, "pairs.toml"));
  REQUIRE(model.reduction);
  REQUIRE(model.reduction->modes == 2);
  const Eigen::MatrixXd& x = model.reduction->shapes;
  Eigen::Matrix4d sizes = Eigen::Matrix4d::Zero();  // |K|
  sizes.diagonal() << 1.000003e6, 1.000002e6, 1.000002e6, 1.000001e6;
  for (int i = 0; i < 3; ++i) sizes(i, i + 1) = sizes(i + 1, i) = i == 1 ? 2.0 : 1.0e6;
  const double terms = x.col(0).cwiseAbs().dot(sizes * x.col(1).cwiseAbs());
  const double unit = std::log2(model.reduction->stiffness_terms(0, 1) / terms);  // a power of two
  CHECK(std::abs(unit - std::round(unit)) < 1e-9);
  const auto m = [&](int i) { return model.mass.coeff(i, i); };
  const auto k = [&](int i) { return model.stiffness.coeff(i, i); };
  // x_0' = x_0 + C_01 x_1 + ..., C_01 (lambda_0 m_1 - K_11) = 1e-15 r |x_0|^T |K| |x_1|, 1/2 <= |r| <= 1
  const double whole = 1e-15 * model.reduction->stiffness_terms(0, 1) / std::abs(k(0) / m(0) * m(1) - k(1));
  CHECK(whole > 1e-10);
  const Eigen::MatrixXd own = x.leftCols(2);
  double signs = 0.0;
  for (std::uint64_t seed = 1; seed < 9; ++seed) {
    CAPTURE(seed);
    const Model near = certify::perturbed(model, seed);
    const Eigen::MatrixXd& now = near.reduction->shapes;
    const Eigen::VectorXd off = (now - x).col(0), part = base::least_squares(own, off);
    const double mixed = part[1] / whole;
    CHECK(std::abs(mixed) > 0.44);  // a factor 1 + 1e-15 r is rounded itself
    CHECK(std::abs(mixed) < 1.12);
    signs += mixed > 0.0 ? 1.0 : -1.0;
    // The forms are those of the shapes, and the state is where it was.
    const Contact &before = model.contacts[0], &after = near.contacts[0];
    const Eigen::MatrixXd turned = base::least_squares(x, now);
    CHECK((of_shapes(near, after.normal) - turned.transpose() * of_shapes(model, before.normal)).norm() <=
          1e-13);
    CHECK((of_shapes(near, after.tangent) - turned.transpose() * of_shapes(model, before.tangent)).norm() <=
          1e-13);
    CHECK((now * near.u0 - x * model.u0).norm() <= 1e-14 * (x * model.u0).norm());
    CHECK((now * near.v0 - x * model.v0).norm() <= 1e-14 * (x * model.v0).norm());
  }
  CHECK(std::abs(signs) < 8.0);
}

TEST_SUITE_END();
