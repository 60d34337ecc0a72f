#include "certify/disturb.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "signorini/model.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/certify/disturb");

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
  REQUIRE(model.reduction->cancellation.size() > 0);
  const double c = std::cos(std::numbers::pi / (n + 1));
  CHECK(model.reduction->cancellation[0] == doctest::Approx((1.0 + c) / (1.0 - c)).epsilon(1e-9));
  double greatest = 0.0;
  for (std::uint64_t seed = 1; seed < 9; ++seed)
    greatest = std::max(
        greatest, std::abs(disturbed(model, seed).stiffness.coeff(0, 0) / model.stiffness.coeff(0, 0) - 1.0));
  CHECK(greatest > 0.5e-15 * model.reduction->cancellation[0]);
  CHECK(greatest < 2.3e-15 * model.reduction->cancellation[0]);
}

TEST_SUITE_END();
