// Bars of plane elements that hit the ground: closed forms of the one-dimensional wave.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

/// Along x, its left end on the ground; E = c^2, density 1, area 1. A massless boundary, as stiff as ten elements.
Scene falling_bar(int n, double length, double c, double gap, double speed, double g, double t_end,
                  double dt) {
  return parse_scene(fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
gravity = [{0:.17g}, 0.0]
run = {{ t_end = {1:.17g}, engine = "exact", output_dt = {2:.17g}, certify = false, initial = {{ bar = {{ vx = {3:.17g} }} }} }}
[[bodies]]
name = "bar"
rectangle = {{ size = [{4:.17g}, 1.0] }}
elements = [{5}, 1]
E = {6:.17g}
nu = 0.0
density = 1.0
plane = "stress"
[[supports]]
nodes = ["bar.bottom"]
fix = ["uy"]
[[seams]]
name = "wall"
slave = "bar.left"
master = "ground"
law = "compliant"
normal_stiffness = {7:.17g}
gap = {8:.17g}
contact_mass = "none"
)",
                                 -g, t_end, dt, -speed, length, n, c * c, 10.0 * c * c * n / length, gap),
                     "bar.toml");
}

struct Stay {
  double begin = 0.0, end = 0.0;  ///< first contact, last before the bar has gone
  double force = 0.0;             ///< mean over the middle half
};

Stay stay_of(const Result& result, double begin, double end) {
  Stay stay;
  for (const Event& e : result.events) {
    if (is_open(e.from) && stay.begin == 0.0) stay.begin = e.t;
    if (is_open(e.to)) stay.end = e.t;
  }
  int rows = 0;
  for (const auto& row : result.rows)
    if (row.t >= begin + 0.25 * (end - begin) && row.t <= begin + 0.75 * (end - begin)) {
      for (const ContactSample& c : row.contacts) stay.force -= c.N;
      ++rows;
    }
  stay.force /= rows;
  return stay;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/bar_impacts");

TEST_CASE("a bar hits the ground: it stays 2 L / c and presses with rho c v, closer on finer meshes") {
  double before = 1.0;
  for (const int n : {40, 80, 160}) {
    CAPTURE(n);
    const Result result = simulate(falling_bar(n, 1.0, 10.0, 0.0, 1.0, 0.0, 0.3, 5e-4));
    REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
    const Stay stay = stay_of(result, 0.0, 0.2);
    const double off = std::abs(stay.end / 0.2 - 1.0);
    CHECK(off <= 0.01);
    const double force_off = std::abs(stay.force / 10.0 - 1.0);
    CHECK(force_off <= 0.01);
    CHECK(force_off <= 0.5 * before);
    // Energy is kept.
    const auto& first = result.rows.front().energy;
    for (const auto& row : result.rows)
      CHECK(std::abs(row.energy.balance() - first.balance()) <= 1e-9 * first.stored());
    before = force_off;
  }
}

TEST_CASE(
    "the bouncing bar of Doyen, Ern and Piperno: falls 1 s, stays 2 L / c, presses with rho c (v + g t)") {
  // L = 10, c = 30, height 5, g = 10: v = 10, 2 L/c = 2/3. In the frame that falls freely the end moves by v + g t; the wave comes
  // back as -2 (v + g (t - 2 L/c)), which pulls as g 2 L/c < v. The middle leaves with v.
  const int n = 80;
  const Scene scene = falling_bar(n, 10.0, 30.0, 5.0, 0.0, 10.0, 2.0, 2e-3);
  const Model model = build_model(scene);
  const Result result = simulate(model, scene.run);
  REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
  const Stay stay = stay_of(result, 1.0, 1.0 + 2.0 / 3.0);
  CHECK(std::abs(stay.begin - 1.0) <= 1e-8);
  CHECK(std::abs(1.5 * (stay.end - 1.0) - 1.0) <= 0.02);
  CHECK(stay.force == doctest::Approx(30.0 * (10.0 + 10.0 / 3.0)).epsilon(0.01));
  // v_cm = m^-1 r M v of what has mass.
  Vector along = Vector::Zero(model.size());
  for (const DrawnNode& node : model.drawn_nodes) along[node.dofs[0]] = 1.0;
  const auto& last = result.rows.back();
  const double mass = along.dot(model.mass * along), speed = along.dot(model.mass * last.v) / mass;
  CHECK(mass == doctest::Approx(10.0).epsilon(1e-12));
  CHECK(speed == doctest::Approx(10.0 - 10.0 * (last.t - stay.end)).epsilon(0.02));
  for (const auto& row : result.rows)
    CHECK(std::abs(row.energy.balance() - result.rows.front().energy.balance()) <= 1e-9 * 500.0);
}

TEST_SUITE_END();
