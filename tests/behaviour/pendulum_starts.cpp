// Static starts of a slab on pendulums, turned: what they bear settles however its digits are rounded.
//
//   N_1 + N_2 = W,   x_1 N_1 + x_2 N_2 = h H,   ut = H / (N_1 / R_1 + N_2 / R_2)      feet at (x_i, -h), kn g_i = -N_i
//
// Where the slab stands far along the surface, kn times its place there is far above N, and rounding of the one shows in
// the other as soon as axes are not those of the surface.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <string>

#include "behaviour/scene_parts.hpp"
#include "signorini/model.hpp"
#include "signorini/scene.hpp"

namespace signorini::tests::pendulum_starts {
namespace {

constexpr double H = 25.0, W = 300.0, h = 0.5, kn_soft = 3e4;
constexpr std::array x{-1.1, 1.9}, R{1.7, 2.3};

struct Axes {
  double c, s;
  explicit Axes(double angle) : c(std::cos(angle)), s(std::sin(angle)) {}
  [[nodiscard]] std::string at(double along, double across) const {
    return fmt::format("[{:.17g}, {:.17g}]", c * along - s * across, s * along + c * across);
  }
};

std::string slab(const Axes& axes, double kn, const std::string& friction) {
  std::string text = parts::head + parts::run_table(1.0, 0.5, "static") +
                     fmt::format("[nodes]\nL = {}\nR = {}\n", axes.at(x[0], -h), axes.at(x[1], -h)) +
                     "[[rigid]]\nname = \"slab\"\ncentre = [0.0, 0.0]\nnodes = [\"L\", \"R\"]\nmass = "
                     "30.0\ninertia = 12.0\n";
  for (std::size_t i = 0; i < 2; ++i)
    text += fmt::format(
        "[[pendulums]]\nname = \"p{0}\"\nnode = \"{0}\"\nnormal = {1}\nradius = {2:.17g}\nnormal_stiffness = "
        "{3:.17g}\n{4}",
        i == 0 ? "L" : "R", axes.at(0.0, 1.0), R.at(i), kn, friction);
  for (const auto& [along, across, size] : {std::array{1.0, 0.0, H}, std::array{0.0, -1.0, W}})
    text += fmt::format("[[loads]]\nnode = \"slab\"\ndirection = {}\namplitude = {}\n",
                        axes.at(along, across), size);
  return text;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/pendulum_starts");

TEST_CASE("a slab that wind pushes stands where statics say, at every angle and however stiff its bearings") {
  const double right = (h * H - x[0] * W) / (x[1] - x[0]), left = W - right;
  const double ut = H / (left / R[0] + right / R[1]);
  for (const double kn : {kn_soft, 4e5, 1e7, 1e9})
    for (int turn = 0; turn < 24; ++turn)
      for (const char* friction : {"", "friction = 0.06\ntangential_stiffness = 3e4\n"}) {
        const double angle = 0.2618 * turn + (turn % 3 == 0 ? 0.0 : 0.0371);
        CAPTURE(kn);
        CAPTURE(angle);
        const Model model = build_model(parse_scene(slab(Axes(angle), kn, friction), "test.toml"));
        // kn ut is what rounding of N is relative to.
        const double digits = 1e-13 * (W + kn * ut);
        CHECK(std::abs(model.statics.reactions[0] - left) < digits);
        CHECK(std::abs(model.statics.reactions[1] - right) < digits);
        const double rz = (left - right) / kn / (x[1] - x[0]);
        const double along = std::cos(angle) * model.u0[0] + std::sin(angle) * model.u0[1];
        CHECK(along + h * rz == doctest::Approx(ut).epsilon(1e-9));
        CHECK(std::abs(model.u0[2] - rz) < 1e-12);
      }
}

TEST_SUITE_END();

}  // namespace signorini::tests::pendulum_starts
