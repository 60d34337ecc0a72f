#include "certify/data_perturbation.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "signorini/model.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/certify/data_perturbation");

TEST_CASE("stiffnesses of a reduced model are off by what the entries of K leave where they cancel") {
  // A chain of equal springs k and masses m between walls: x_j = sin(j pi / (n + 1)) for the lowest mode, and
  //   x^T K x = 2 k (1 - c) x^T x,   |x|^T |K| |x| = 2 k (1 + c) x^T x,   c = cos(pi / (n + 1))
  constexpr int n = 40;
  std::string scene =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\nt_end = "
      "1.0\n[reduction]\ncutoff_omega = 0.2\n[matrices]\n";
  std::string mass = "mass = [", stiffness = "stiffness = [";
  for (int i = 0; i < n; ++i) {
    mass += "[", stiffness += "[";
    for (int j = 0; j < n; ++j) {
      mass += i == j ? "1.0, " : "0.0, ";
      stiffness += i == j ? "2.0, " : std::abs(i - j) == 1 ? "-1.0, " : "0.0, ";
    }
    mass += "], ", stiffness += "], ";
  }
  const Model model = build_model(parse_scene(scene + mass + "]\n" + stiffness + "]\n", "chain.toml"));
  REQUIRE(model.reduction);
  REQUIRE(model.reduction->stiffness_terms.rows() > 0);
  const double cancellation = model.reduction->stiffness_terms(0, 0) / model.stiffness.coeff(0, 0);
  const double c = std::cos(std::numbers::pi / (n + 1));
  CHECK(cancellation == doctest::Approx((1.0 + c) / (1.0 - c)).epsilon(1e-9));
  double greatest = 0.0;
  for (std::uint64_t seed = 1; seed < 9; ++seed)
    greatest = std::max(
        greatest,
        std::abs(certify::perturbed(model, seed).stiffness.coeff(0, 0) / model.stiffness.coeff(0, 0) - 1.0));
  CHECK(greatest > 0.5e-15 * cancellation);
  CHECK(greatest < 2.3e-15 * cancellation);
}

namespace {

/// The static displacement of two masses by Cramer's rule, to more digits than doubles have.
/// kt, T: of a spring of friction along the second, whose sliding point is where it was at `from`.
std::array<long double, 2> displacement(const Model& model, long double kt = 0.0L, long double T = 0.0L,
                                        double from = 0.0) {
  const auto k = [&](int i, int j) { return static_cast<long double>(model.stiffness.coeff(i, j)); };
  const Contact& c = model.contacts[0];
  const long double kn = c.normal_stiffness, n = c.normal.terms.front().second;
  long double p[2] = {-kn * n * c.gap, 0.0L};
  for (const Load& load : model.loads)
    for (const auto& [dof, factor] : load.direction.terms)
      p[dof] += static_cast<long double>(factor) * load.history.value(0.0);
  p[1] -= T - kt * from;
  const long double a = k(0, 0) + kn * n * n, b = k(0, 1), d = k(1, 1) + kt, det = a * d - b * b;
  return {(p[0] * d - b * p[1]) / det, (a * p[1] - b * p[0]) / det};
}

}  // namespace

namespace {

/// K = [k + s, -s; -s, s]: the sum k + s is off by a rounding of s, the soft motion by s/k as many of itself.
constexpr const char* soft = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
run = { t_end = 1.0, initial = "static" }
[matrices]
dofs = ["a", "b"]
mass = [[1.0, 0.0], [0.0, 2.0]]
stiffness = [[1.0e7, -1.0e7], [-1.0e7, 1.0e7]]
[[contacts]]
name = "foot"
law = "compliant"
normal = { a = -1.0 }
tangent = { b = 1.0 }
gap = 0.01
normal_stiffness = 3.0
tangential_stiffness = 2.0
friction = 0.4
[[loads]]
direction = { a = 0.3, b = 1.0 }
amplitude = 5.0
history = { type = "constant" }
)";

}  // namespace

TEST_CASE("a static start follows its data: a stiff bar on a soft spring and a compliant foot") {
  const Model model = build_model(parse_scene(soft, "soft.toml"));
  REQUIRE(model.static_start);
  const auto first = displacement(model);
  for (std::uint64_t seed = 1; seed < 5; ++seed) {
    CAPTURE(seed);
    const Model near = certify::perturbed(model, seed);
    const auto moved = displacement(near);
    for (int i = 0; i < 2; ++i) {
      const auto expected =
          static_cast<double>(moved[static_cast<std::size_t>(i)] - first[static_cast<std::size_t>(i)]);
      CHECK(std::abs(expected) > 1e-11 * std::abs(model.u0[i]));  // far more than a rounding
      CHECK(near.u0[i] - model.u0[i] == doctest::Approx(expected).epsilon(1e-5));
    }
    CHECK(near.contacts[0].gap_at(near.u0) < 0.0);
  }
}

TEST_CASE(
    "a start that friction holds below its limit follows its data, and its shear with it; at its limit it "
    "stays at the limit of its data") {
  Model model = build_model(parse_scene(soft, "soft.toml"));
  Contact& foot = model.contacts[0];
  // T on top of all: its load balances it. The limit is 0.4 N.
  const double T = 0.3 * model.statics.reactions[0], from = model.u0[1];
  model.statics.frictional = true;
  foot.initial_shear = T;
  Load more = model.loads[0];
  more.direction = foot.tangent;
  more.history = History::constant(T);
  model.loads.push_back(more);
  const long double own = *foot.tangential_stiffness;
  const auto first = displacement(model, own, T, from);
  for (std::uint64_t seed = 1; seed < 5; ++seed) {
    CAPTURE(seed);
    const Model near = certify::perturbed(model, seed);
    const double kt = *near.contacts[0].tangential_stiffness;
    const long double begun = T * static_cast<long double>(kt) / own;
    const auto moved = displacement(near, kt, begun, from);
    for (int i = 0; i < 2; ++i) {
      const auto expected =
          static_cast<double>(moved[static_cast<std::size_t>(i)] - first[static_cast<std::size_t>(i)]);
      CHECK(std::abs(expected) > 1e-11 * std::abs(model.u0[i]));
      CHECK(near.u0[i] - model.u0[i] == doctest::Approx(expected).epsilon(1e-5));
    }
    const double shear = static_cast<double>(begun - T + kt * (moved[1] - first[1]));
    CHECK(near.contacts[0].initial_shear - T == doctest::Approx(shear).epsilon(1e-4));
  }
  foot.initial_shear = 0.4 * model.statics.reactions[0];
  const Contact near = certify::perturbed(model, 3).contacts[0];
  const Vector at = certify::perturbed(model, 3).u0;
  CHECK(at != model.u0);
  CHECK(near.initial_shear ==
        doctest::Approx(near.friction.static_ * -*near.resting_force(at)).epsilon(1e-15));
  foot.initial_shear = T;
  foot.initial_slip = 1;
  CHECK(certify::perturbed(model, 3).u0 == model.u0);
}

TEST_CASE("what touches without force stays as it is, and what is apart does not") {
  // The gap of the second contact is closed, and it bears nothing.
  const std::string scene = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
run = { t_end = 1.0, initial = "static" }
[matrices]
dofs = ["a", "b"]
mass = [[1.0, 0.0], [0.0, 1.0]]
stiffness = [[1.00000003e7, -1.0e7], [-1.0e7, 1.0e7]]
[[contacts]]
name = "touching"
law = "compliant"
normal = { a = -1.0, b = 2.0 }
normal_stiffness = 3.0e3
gap = 0.0
[[loads]]
direction = { b = 1.0 }
amplitude = 5.0
history = { type = "constant" }
)";
  Model model = build_model(parse_scene(scene, "touching.toml"));
  model.contacts[0].gap = -model.contacts[0].normal.dot(model.u0);
  const Model near = certify::perturbed(model, 3);
  CHECK(std::abs(near.contacts[0].gap_at(near.u0)) <= 1e-15 * std::abs(model.contacts[0].gap));
  model.contacts[0].gap += 1.0;  // apart
  CHECK(std::abs(certify::perturbed(model, 3).u0[0] - model.u0[0]) > 1e-10 * std::abs(model.u0[0]));
}

TEST_SUITE_END();
