// Elastic blocks and stacks on ground that moves, beside the closed form of rigid ones (Newmark 1965).
//
//   ground: acceleration a(t), velocity V(t);   limit N = f g;   slip begins where a = N, ends where the block has V again
//   jump:   a = A for a time T                  slip = (A T)^2/(2 N) (1 - N/A)
//   pulse:  a = A sin(w t) for a time pi/w      slip = int (V - v) dt,  v = V(t1) + N (t - t1),  sin(w t1) = N/A
//
// How far elastic blocks are from it. The foot carries T <= f W; as long as a node sticks, the block follows the ground.
//
//   at a jump the shear that runs into the block needs a time d = O(h/c) to reach f p: until then the foot bears less than f W, so
//   the block lags by N d ever after and slips V d farther:   O(1/c), with the root of E
//   at a pulse a node after the other slips while a grows. Slow growth: with the last one the block lags by the rate at which the
//   strains grow, a'(t1)/w^2, w^2 = k/m, k: stiffness of the foot that still sticks: O(1/E). These blocks are between both.
//
// Without damping the sliding foot flutters, so all shapes of motion have the same damping at any E.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

constexpr double gravity = 10.0, jump_A = 5.0, jump_T = 0.05, pulse_A = 3.0, pulse_T = 0.1;

double jump_slip(double N) {
  const double V = jump_A * jump_T;
  return V * V / (2.0 * N) * (1.0 - N / jump_A);
}

/// N t_end = V: no slip is left at this time.
double jump_end(double N) { return jump_A * jump_T / N; }

struct PulseSlip {
  double slip = 0.0, end = 0.0;
};
/// By the integrals of V and v; the pulse ends while the block slips.
PulseSlip pulse_slip(double N) {
  const double w = std::numbers::pi / pulse_T, t1 = std::asin(N / pulse_A) / w;
  const double v1 = pulse_A / w * (1.0 - std::cos(w * t1)), V = 2.0 * pulse_A / w;
  const double end = t1 + (V - v1) / N;
  const auto way = [&](double t) {
    return pulse_A / w * (t - std::sin(w * t) / w);
  };  // of the ground, t <= T
  const double ground = way(pulse_T) - way(t1) + V * (end - pulse_T);
  return {ground - v1 * (end - t1) - N * (end - t1) * (end - t1) / 2.0, end};
}

struct Stack {
  double degrees = 0.0, E = 1e8;
  bool pulse = true;
  double below = 0.1;           ///< friction of the foot
  std::vector<double> above{};  ///< of the joints, from below
  double damping = 0.05;        ///< beta sqrt(E/rho)/h: of each shape of motion the same at any E

  [[nodiscard]] double least() const {
    double f = below;
    for (const double joint : above) f = std::min(f, joint);
    return f;
  }
  [[nodiscard]] double slip() const {
    return pulse ? pulse_slip(least() * gravity).slip : jump_slip(least() * gravity);
  }
  [[nodiscard]] double t_end() const {
    return 1.1 * (pulse ? pulse_slip(least() * gravity).end : jump_end(least() * gravity));
  }
  [[nodiscard]] std::string text() const {
    const double a = degrees * std::numbers::pi / 180.0, c = std::cos(a), s = std::sin(a);
    std::string text =
        fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
gravity = [{:.17g}, {:.17g}]
run = {{ t_end = {:.17g}, engine = "exact", initial = "static", output_times = [0.0, {:.17g}], certify = false }}
damping = {{ alpha = 0.0, beta = {} }}
)",
                    gravity * s, -gravity * c, t_end(), t_end(), damping * 0.1 / std::sqrt(E / 2000.0));
    for (std::size_t i = 0; i <= above.size(); ++i) {
      const double n = 4.0 + static_cast<double>(i), width = 0.4 - 0.04 * static_cast<double>(i);
      const double x = 0.5 * (0.4 - width), y = 0.1 * static_cast<double>(i);
      text += fmt::format(
          R"([[bodies]]
name = "block{}"
rectangle = {{ from = [{:.17g}, {:.17g}], size = [{}, 0.1], degrees = {} }}
elements = [{}, 2]
E = {}
nu = 0.2
density = 2000.0
plane = "stress"
[[seams]]
name = "joint{}"
slave = "block{}.bottom"
master = "{}"
friction = {}
contact_mass = "none"
law = "compliant"
normal_stiffness = {}
tangential_stiffness = {}
)",
          i, c * x - s * y, s * x + c * y, width, degrees, n, E, i, i,
          i == 0 ? std::string("ground") : fmt::format("block{}.top", i - 1), i == 0 ? below : above[i - 1],
          100.0 * E / 0.1, 100.0 * E / 0.1);
    }
    return text + fmt::format(
                      "[[base_motion]]\ndirection = [{:.17g}, "
                      "{:.17g}]\nacceleration = {{ type = \"{}\", "
                      "amplitude = {}, start = 0.0, {} = {} }}\n",
                      c, s, pulse ? "half_sine" : "rectangle", pulse ? pulse_A : jump_A,
                      pulse ? "duration" : "end", pulse ? pulse_T : jump_T);
  }
};

/// Mean slip of each seam from the start, where strains of the weight are there already, to the end; from below.
std::vector<double> slips(const Stack& stack) {
  const Scene scene = parse_scene(stack.text(), "stack.toml");
  const Result result = simulate(scene);
  REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
  CHECK(result.report.law_checks.violated == 0);
  std::vector<double> mean;
  for (const SeamSpec& seam : scene.seams) {
    double sum = 0.0;
    for (std::size_t i = 0; i < seam.nodes.size(); ++i)
      sum += result.rows.back().contacts[seam.first_contact + i].slip -
             result.rows.front().contacts[seam.first_contact + i].slip;
    mean.push_back(-sum / static_cast<double>(seam.nodes.size()));
  }
  return mean;
}

/// To the rigid block like 1/sqrt(E) at a jump, faster at a pulse.
void check_stiffer_blocks(const std::vector<double>& moduli) {
  for (const bool pulse : {false, true}) {
    CAPTURE(pulse);
    double before = 0.0;
    for (const double E : moduli) {
      CAPTURE(E);
      const Stack stack{.degrees = 33.7, .E = E, .pulse = pulse};
      const double off = slips(stack)[0] / stack.slip() - 1.0;
      CHECK(off > 0.0);
      if (before > 0.0 && !pulse) CHECK(before / off == doctest::Approx(2.0).epsilon(0.05));
      if (before > 0.0 && pulse) CHECK(before / off >= 2.0);
      if (E == 4e8) CHECK(off <= 1e-3);
      before = off;
    }
  }
}

/// Friction of the foot and of the joint above it: the stack slides where it is least, and nowhere else.
void check_stack(double below, double above) {
  const Stack stack{.degrees = -21.0, .below = below, .above = {above}};
  const std::vector<double> all = slips(stack);
  for (std::size_t i = 0; i < all.size(); ++i) {
    CAPTURE(i);
    const bool slides = (i == 0 ? below : above) == stack.least();
    const double off = all[i] / stack.slip() - (slides ? 1.0 : 0.0);
    // Where it does not slide, the ends of the seam creep by elastic strains of f rho g h/G, 1e-7 m and less.
    CHECK(std::abs(off) <= (slides ? 8e-3 : 4e-4));
  }
}

}  // namespace

TEST_SUITE_BEGIN("slow/behaviour/sliding_bodies");

TEST_CASE("a sliding block of Q4: to the rigid block like 1/sqrt(E) at a jump, faster at a pulse") {
  check_stiffer_blocks({2.5e7, 1e8});
}

TEST_CASE("a block slides alike on a ground that is turned") {
  const double flat = slips({.E = 2.5e7, .pulse = false})[0];
  CHECK(slips({.degrees = -61.0, .E = 2.5e7, .pulse = false})[0] == doctest::Approx(flat).epsilon(1e-9));
}

TEST_CASE(
    "a stack slides in its joint, whose friction is less: as far as a rigid block there, nowhere else") {
  check_stack(0.3, 0.1);
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("deep/behaviour/sliding_bodies");

TEST_CASE("a sliding block of Q4 that is sixteen times as stiff: within 1e-3 of the rigid block") {
  check_stiffer_blocks({2.5e7, 1e8, 4e8});
}

TEST_CASE(
    "a stack slides at its foot, whose friction is less: as far as a rigid block, and not in its joint") {
  check_stack(0.1, 0.3);
}

TEST_SUITE_END();
