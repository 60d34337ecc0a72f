// A block on two rigid feet at unequal heights, pushed harder and harder: its forces have the least sum of squares.
//
//   N_L + N_R = -m g,   T_L + T_R = P,   sum (r_y T - r_x N) = h P         four forces, three equations: x = x0 + y z
//   min |x|^2 within |T_i| <= -f N_i:   y = 0 (x0 is orthogonal to z), or the end of the feasible interval next to it
//
// So N depends on the share as T does. The parabola on an interval is solved here; no code is shared with the program.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <optional>
#include <random>

#include "behaviour/scene_parts.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::uneven_feet {
namespace {

constexpr double g = 9.81;

struct Block {
  double w, step, x, y, top_x, top_y, f,
      ramp;  // foot R at (w, step), centre (x, y), P = ramp t at (top_x, top_y)
};

/// nullopt: no forces within the cones hold the block.
std::optional<Eigen::Vector4d> least(const Block& b, double P) {
  Eigen::Matrix<double, 3, 4> a;  // N_L, T_L, N_R, T_R
  a << 1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0, b.x, -b.y, b.x - b.w, b.step - b.y;
  const Eigen::Vector3d right(-g, P, (b.top_y - b.y) * P);
  const Eigen::Vector4d x0 = a.transpose() * (a * a.transpose()).ldlt().solve(right);
  const Eigen::Vector4d z = Eigen::FullPivLU<Eigen::Matrix<double, 3, 4>>(a).kernel().col(0).normalized();
  double low = -1e9, high = 1e9;
  for (const int foot : {0, 2})
    for (const double side : {1.0, -1.0}) {
      const double room = -b.f * x0[foot] - side * x0[foot + 1], rate = -b.f * z[foot] - side * z[foot + 1];
      (rate > 0.0 ? low : high) = rate > 0.0 ? std::max(low, -room / rate) : std::min(high, -room / rate);
    }
  if (low > high) return std::nullopt;
  return x0 + std::clamp(0.0, low, high) * z;
}

/// The time at which the block can no longer rest, at most `end`.
double last_rest(const Block& b, double end) {
  if (least(b, b.ramp * end)) return end;
  double rests = 0.0, moves = end;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (rests + moves);
    (least(b, b.ramp * middle) ? rests : moves) = middle;
  }
  return rests;
}

/// mirror: -1 looks at the block from behind. permuted: foot R comes first in the scene.
std::string scene_text(const Block& b, double mirror, bool permuted) {
  std::string text = parts::head + fmt::format("gravity = [0.0, {}]\n", -g) +
                     "[run]\nt_end = 1.0\ninitial = \"static\"\noutput_dt = 0.01\n" +
                     fmt::format("[nodes]\nL = [0.0, 0.0]\nR = [{:.17g}, {:.17g}]\nT = [{:.17g}, {:.17g}]\n",
                                 mirror * b.w, b.step, mirror * b.top_x, b.top_y) +
                     fmt::format(
                         "[[rigid]]\nname = \"B\"\ncentre = [{:.17g}, {:.17g}]\nnodes = [\"L\", \"R\", "
                         "\"T\"]\nmass = 1.0\ninertia = 0.2\n",
                         mirror * b.x, b.y);
  for (const char* foot : {permuted ? "R" : "L", permuted ? "L" : "R"})
    text += fmt::format(
        "[[contacts]]\nname = \"{0}\"\nnode = \"{0}\"\nlaw = \"rigid\"\nnormal = [0.0, 1.0]\nfriction = "
        "{1}\n",
        foot, b.f);
  return text +
         fmt::format(
             "[[loads]]\nnode = \"T\"\ndirection = [{}, 0.0]\namplitude = {:.17g}\nhistory = {{ type = "
             "\"polynomial\", coefficients = [0.0, 1.0], start = 0.0 }}\n",
             mirror, b.ramp);
}

void check_case(const Block& b, double mirror, bool permuted, const std::string& engine) {
  CAPTURE(mirror);
  CAPTURE(permuted);
  CAPTURE(engine);
  const Scene read = parse_scene(scene_text(b, mirror, permuted), "test.toml",
                                 {{"run.engine", engine}, {"run.certify", "false"}});
  const Result result = simulate(build_model(read), read.run);
  CHECK(result.report.outcome.reason == "");
  CHECK(result.report.law_checks.violations.empty());
  const double end = last_rest(b, 1.0);
  int rows = 0;
  for (const Result::Row& row : result.rows) {
    if (row.t > end - 1e-6) break;
    CAPTURE(row.t);
    const Eigen::Vector4d x = *least(b, b.ramp * row.t);
    const std::size_t left = permuted ? 1 : 0;
    CHECK(row.contacts[left].N == doctest::Approx(x[0]).epsilon(1e-9).scale(g));
    CHECK(row.contacts[left].T == doctest::Approx(mirror * x[1]).epsilon(1e-9).scale(g));
    CHECK(row.contacts[1 - left].N == doctest::Approx(x[2]).epsilon(1e-9).scale(g));
    CHECK(row.contacts[1 - left].T == doctest::Approx(mirror * x[3]).epsilon(1e-9).scale(g));
    ++rows;
  }
  CHECK(rows > 1);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/uneven_feet");

TEST_CASE("forces of a block on feet at unequal heights have the least sum of squares within the cones") {
  const Block known{0.581, 0.277, 0.338, 0.626, 0.338, 1.998, 0.34, -11.772};
  for (const double mirror : {1.0, -1.0})
    for (const bool permuted : {false, true}) check_case(known, mirror, permuted, "exact");
  const Eigen::Vector4d x = *least(known, known.ramp * 0.08);
  CHECK(x[0] == doctest::Approx(-6.864).epsilon(1e-3));
  CHECK(x[3] == doctest::Approx(-1.002).epsilon(1e-3));
}

TEST_CASE("twenty random blocks, pushed either way, seen from behind, in both orders") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int i = 0; i < 20; ++i) {
    CAPTURE(i);
    const double w = 0.4 + 0.6 * part(random), y = 0.4 + 0.5 * part(random),
                 x = w * (0.3 + 0.4 * part(random));
    const Block b{w,
                  0.6 * part(random) - 0.3,
                  x,
                  y,
                  x,
                  y + 1.5 * part(random),
                  0.15 + 0.5 * part(random),
                  part(random) < 0.5 ? 11.772 : -11.772};
    check_case(b, 1.0, false, "exact");
    check_case(b, -1.0, i % 2 == 0, "exact");
    check_case(b, 1.0, true, "ida");
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::uneven_feet
