// A block that rocks on two feet without friction, with Newton's restitution: against a follower of its two gaps.
//
//   g_L = y - b th,  g_R = y + b th;   free: y'' = -g, th'' = 0;   on one foot: N = g / W,  W = 1/m + b^2/I
//   a hit of one foot: J = (1 + e) |v| / W, and the other, which stands or flies, gains (1/m - b^2/I) J
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "behaviour/engines.hpp"
#include "behaviour/scene_parts.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::rocking_restitution {
namespace {

constexpr double m = 2.3, b = 0.31, h = 1.17, g = 9.81, tilt = 0.02;
constexpr double I = m * (4.0 * b * b + 4.0 * h * h) / 12.0, own = 1.0 / m + b * b / I,
                 other = 1.0 / m - b * b / I;

struct Hit {
  double t;
  std::size_t foot;
};

/// The gap of each foot and its rate; `stands`: the foot that bears the block, 2: none.
struct Follower {
  std::array<double, 2> gap{0.0, 2.0 * b*tilt}, rate{0.0, 0.0};
  std::size_t stands = 0;
  double t = 0.0;

  [[nodiscard]] std::array<double, 2> acceleration() const {
    std::array<double, 2> a{-g, -g};
    if (stands == 2) return a;
    a[stands] = 0.0;
    a[1 - stands] = -g + other * g / own;
    return a;
  }
  /// The first time at which a foot that does not stand has come down.
  [[nodiscard]] std::pair<double, std::size_t> next() const {
    double first = 1e9;
    std::size_t which = 0;
    const auto a = acceleration();
    for (std::size_t i = 0; i < 2; ++i) {
      if (i == stands) continue;
      const double at = (rate[i] + std::sqrt(rate[i] * rate[i] - 2.0 * a[i] * gap[i])) / -a[i];
      if (at < first) {
        first = at;
        which = i;
      }
    }
    return {first, which};
  }
  Hit hit(double e) {
    const auto [dt, foot] = next();
    const auto a = acceleration();
    for (std::size_t i = 0; i < 2; ++i) {
      gap[i] += dt * (rate[i] + 0.5 * dt * a[i]);
      rate[i] += dt * a[i];
    }
    t += dt;
    gap[foot] = 0.0;
    const double impulse = (1.0 + e) * -rate[foot] / own;
    rate[foot] *= -e;
    rate[1 - foot] += other * impulse;  // up: the block is slender
    stands = e > 0.0 ? 2 : foot;
    return {t, foot};
  }
};

}  // namespace

TEST_SUITE_BEGIN("behaviour/rocking_restitution");

TEST_CASE("a block that rocks with restitution hits when and where the follower of its gaps says") {
  static_assert(other > 0.0);
  for (const double e : {0.0, 0.35, 0.8})
    for (const std::string& engine : engines) {
      CAPTURE(e);
      CAPTURE(engine);
      const std::string text =
          parts::head +
          fmt::format(
              "gravity = [0.0, {}]\n[run]\nt_end = 3.0\nrtol = 1e-11\nengine = \"{}\"\ncertify = false\n"
              "initial = {{ block = {{ uy = {:.17g}, rz = {:.17g} }} }}\n",
              -g, engine, tilt * b, tilt) +
          fmt::format(
              "[nodes]\nL = [{}, 0.0]\nR = [{}, 0.0]\n[[rigid]]\nname = \"block\"\ncentre = [0.0, {}]\n"
              "nodes = [\"L\", \"R\"]\nmass = {}\ninertia = {:.17g}\n",
              -b, b, h, m, I) +
          fmt::format(
              "[[contacts]]\nname = \"foot\"\nnodes = [\"L\", \"R\"]\nlaw = \"rigid\"\nnormal = [0.0, 1.0]\n"
              "restitution = {}\n",
              e);
      const Scene scene = parse_scene(text, "test.toml");
      const Result result = simulate(build_model(scene), scene.run);
      CHECK(result.report.law_checks.violations.empty());
      std::vector<Hit> hits;
      for (const Event& event : result.events)
        if (event.type == EventType::impact)
          hits.push_back({event.t, static_cast<std::size_t>(event.contact)});
      REQUIRE(hits.size() >= 10);
      Follower follower;
      double error = 0.0;
      for (std::size_t i = 0; i < 10; ++i) {
        const Hit expected = follower.hit(e);
        error = std::max(error, std::abs(hits[i].t - expected.t));
        CHECK(hits[i].foot == expected.foot);
      }
      CHECK(error < (engine == "exact" ? 1e-11 : 1e-7));
    }
}

TEST_SUITE_END();

}  // namespace signorini::tests::rocking_restitution
