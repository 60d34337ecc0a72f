// A block in a corner: pressed against a smooth or rough rigid wall, on a rigid floor that oscillates below it.
//
//   s' = V sin(w t + phi),  slip rate of the floor  -s',  T = -sign(s') f m g,  N_wall = -(F - T)     while F > f m g
//
// The wall holds the block's motion along the floor, so the slip turns with the floor alone, at every zero of s'.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "behaviour/engines.hpp"
#include "behaviour/seen_otherwise.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::moving_corner {
namespace {

constexpr double m = 2.0, g = 10.0, f = 0.4, F = 13.0, V = 0.3, w = 21.0, phi = 0.7, t_end = 1.0;

std::string corner(double angle, const std::string& surface, const char* rest = "") {
  const double x = std::cos(angle), y = std::sin(angle);
  return fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = {0}, output_dt = 0.01, rtol = 1e-9, dt = 1e-3 }}
nodes = {{ A = [0.0, 0.0] }}
masses = [{{ node = "A", mass = {1} }}]
[[loads]]
node = "A"
direction = [{2:.17g}, {3:.17g}]
amplitude = {4}
[[loads]]
node = "A"
direction = [{3:.17g}, {9:.17g}]
amplitude = {5}
[[contacts]]
name = "floor"
node = "A"
law = "rigid"
normal = [{10:.17g}, {2:.17g}]
friction = {6}
surface_velocity = {7}
[[contacts]]
name = "wall"
node = "A"
law = "rigid"
normal = [{9:.17g}, {10:.17g}]
{8}
)",
                     t_end, m, x, y, F, m * g, f, surface, rest, -x, -y);
}

const std::string oscillates =
    fmt::format("{{ type = \"harmonic\", amplitude = {}, omega = {}, phase = {} }}", V, w, phi);

Result run_scene(const std::string& text, const std::string& engine) {
  const Scene scene = parse_scene(text, "test.toml", {{"run.engine", engine}, {"run.certify", "false"}});
  Result result = simulate(build_model(scene), scene.run);
  CHECK(result.report.outcome.reason == "");
  CHECK(result.report.law_checks.violations.empty());
  return result;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/moving_corner");

TEST_CASE(
    "what a wall holds on a floor that oscillates turns its slip at every zero of the floor's velocity") {
  for (const std::string& engine : locating_engines)
    for (const double angle : {0.0, 1.0, -2.1}) {
      CAPTURE(engine);
      CAPTURE(angle);
      const Result result = run_scene(corner(angle, oscillates), engine);
      int turns = 0;
      for (const Event& event : result.events) {
        REQUIRE(event.type == EventType::reversal);
        ++turns;
        CHECK(std::abs(event.t - (turns * std::numbers::pi - phi) / w) < 1e-9);
      }
      CHECK(turns == static_cast<int>((w * t_end + phi) / std::numbers::pi));
      for (const Result::Row& row : result.rows) {
        const double rate = -std::sin(w * row.t + phi);
        if (std::abs(rate) < 1e-3) continue;  // both sides of a turn
        const double T = std::copysign(f * m * g, rate);
        CHECK(row.contacts[0].T == doctest::Approx(T).epsilon(1e-10));
        CHECK(row.contacts[1].N == doctest::Approx(-(F - T)).epsilon(1e-10));
      }
    }
}

TEST_CASE("a wall that rubs and a floor that stands, or oscillates and then stands: slips and rests") {
  // From 0.31 s on the floor stands: the wall holds the block, and nothing slips.
  const std::string stops =
      "{ type = \"table\", times = [0.0, 0.13, 0.21, 0.31], values = [0.1, -0.2, 0.3, 0.0] }";
  for (const std::string& engine : locating_engines) {
    CAPTURE(engine);
    const Result still = run_scene(corner(0.3, "0.0", "friction = 0.2"), engine);
    CHECK(still.events.empty());
    const Result moved = run_scene(corner(0.3, stops, "friction = 0.2"), engine);
    std::vector<double> turns;
    for (const Event& event : moved.events)
      if (event.type == EventType::reversal) turns.push_back(event.t);
    REQUIRE(turns.size() == 2);
    CHECK(turns[0] == doctest::Approx(0.13 / 3.0).epsilon(1e-9));
    CHECK(turns[1] == doctest::Approx(0.13 + 0.08 * 0.4).epsilon(1e-9));
    for (const Result::Row& row : moved.rows)
      if (row.t > 0.32) CHECK(std::abs(row.contacts[0].vt) < 1e-14);  // newmark: a rounding a step
  }
}

TEST_CASE("a corner whose floor oscillates, seen otherwise") {
  check_seen_otherwise(parse_scene(corner(0.0, oscillates, "friction = 0.2"), "corner.toml"), 5);
}

TEST_SUITE_END();

}  // namespace signorini::tests::moving_corner
