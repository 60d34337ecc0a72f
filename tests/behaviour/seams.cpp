// Seams in motion: a block that slides, two blocks that do not match, a bar that hits a wall.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

Scene seam_scene(const std::string& text) {
  return parse_scene(
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n" + text,
      "seams.toml");
}

/// A vector turned by so many degrees, as TOML.
std::string turned_vector(double x, double y, double degrees) {
  const double a = degrees * std::numbers::pi / 180.0, c = std::cos(a), s = std::sin(a);
  return fmt::format("[{:.17g}, {:.17g}]", c * x - s * y, s * x + c * y);
}

/// Two blocks that do not match, on the ground; the upper one is pushed. Lengths times `unit`.
std::string pushed_blocks(const char* engine, double degrees, const char* contact_mass) {
  return fmt::format(
      R"(gravity = {0}
run = {{ t_end = 0.02, engine = "{1}", rtol = 1e-10, output_dt = 0.001 }}
[[bodies]]
name = "low"
rectangle = {{ size = [0.4, 0.1], degrees = {2} }}
elements = [4, 2]
E = 2.0e7
nu = 0.3
density = 2000.0
thickness = 0.1
plane = "stress"
[[bodies]]
name = "high"
rectangle = {{ from = {3}, size = [0.3, 0.2], degrees = {2} }}
elements = [3, 2]
E = 3.0e7
nu = 0.2
density = 2500.0
thickness = 0.1
plane = "stress"
[[seams]]
name = "foot"
slave = "low.bottom"
master = "ground"
law = "compliant"
normal_stiffness = 1.0e9
tangential_stiffness = 4.0e8
friction = 0.5
contact_mass = "{4}"
[[seams]]
name = "joint"
slave = "high.bottom"
master = "low.top"
law = "compliant"
layer = {{ E = 1.0e7, G = 4.0e6, thickness = 0.01 }}
friction = {{ static = 0.4, kinetic = 0.3 }}
contact_mass = "{4}"
[[loads]]
group = "high.left"
traction = 9000.0
direction = {5}
history = {{ type = "half_sine", start = 0.0, duration = 0.01 }}
)",
      turned_vector(0.0, -9.81, degrees), engine, degrees, turned_vector(0.05, 0.1, degrees), contact_mass,
      turned_vector(1.0, 0.0, degrees));
}

void check_same_events(const Result& a, const Result& b, double within) {
  REQUIRE(a.events.size() == b.events.size());
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    CAPTURE(i);
    CHECK(a.events[i].contact == b.events[i].contact);
    CHECK(a.events[i].to == b.events[i].to);
    CHECK(std::abs(a.events[i].t - b.events[i].t) <= within);
  }
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/seams");

TEST_CASE("two blocks that do not match: the same events turned, and of ida; energy and laws are kept") {
  for (const char* mass : {"consistent", "none"}) {
    CAPTURE(mass);
    const Result exact = simulate(seam_scene(pushed_blocks("exact", 0.0, mass)));
    REQUIRE(exact.report.outcome.kind == Outcome::Kind::done);
    CHECK(exact.events.size() > 10);
    CHECK(exact.report.witness.violated == 0);
    double most = 0.0;
    for (const auto& row : exact.rows) most = std::max(most, row.energy.kinetic + row.energy.elastic);
    for (const auto& row : exact.rows)
      CHECK(std::abs(row.energy.balance() - exact.rows.front().energy.balance()) <= 1e-9 * most);
    check_same_events(exact, simulate(seam_scene(pushed_blocks("exact", 33.7, mass))), 1e-10);
    const Result steps = simulate(seam_scene(pushed_blocks("ida", 0.0, mass)));
    check_same_events(exact, steps, 1e-6);
    CHECK(steps.report.witness.violated == 0);
  }
}

TEST_CASE("momentum: the ground's forces are those that change it") {
  const Scene scene = seam_scene(pushed_blocks("exact", 0.0, "none"));
  const Model model = build_model(scene);
  const Result result = simulate(model, scene.run);
  // Of the seams forces cancel between the blocks; d/dt (e . M v) = loads + foot. Over rows of the output by Simpson's rule it
  // would be rough, so the joint's forces are checked for balance at each row instead: their sum on both sides is zero.
  Vector across = Vector::Zero(model.size()), turn = Vector::Zero(model.size());
  for (const DrawnNode& n : model.drawn_nodes) {
    across[n.dofs[0]] = 1.0;
    turn[n.dofs[0]] = -n.y;
    turn[n.dofs[1]] = n.x;
  }
  const SeamSpec& joint = scene.seams[1];
  REQUIRE(joint.name == "joint");
  for (std::size_t k = 0; k < joint.nodes.size(); ++k) {
    const Contact& c = model.contacts[joint.first_contact + k];
    for (const Combination* form : {&c.normal, &c.tangent}) {
      CHECK(std::abs(form->dot(across)) <= 1e-13);
      CHECK(std::abs(form->dot(turn)) <= 1e-12);  // no gap: no moment either
    }
  }
  CHECK(result.report.outcome.kind == Outcome::Kind::done);
}

TEST_CASE("a bar hits a wall: it stays 2 L / c, and presses with rho c v") {
  // L = 1, c = sqrt(E / rho) = 10, v = 1; area 0.01. The wall is as stiff as a tenth of an element.
  const int n = 40;
  const Scene scene = seam_scene(fmt::format(
      R"(run = {{ t_end = 0.3, engine = "exact", output_dt = 0.001, initial = {{ bar = {{ vx = -1.0 }} }} }}
[[bodies]]
name = "bar"
rectangle = {{ size = [1.0, 0.1] }}
elements = [{}, 1]
E = 100.0
nu = 0.0
density = 1.0
thickness = 0.1
plane = "stress"
[[supports]]
nodes = ["bar.bottom"]
fix = ["uy"]
[[seams]]
name = "wall"
slave = "bar.left"
master = "ground"
law = "compliant"
normal_stiffness = {}
contact_mass = "none"
)",
      n, 100.0 * n * 10.0));
  const Result result = simulate(scene);
  REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
  double last_closed = 0.0, force = 0.0;
  int rows = 0;
  for (const auto& row : result.rows) {
    const double N = -(row.contacts[0].N + row.contacts[1].N);
    if (N > 0.0) last_closed = row.t;
    if (row.t > 0.05 && row.t < 0.15) force += N, ++rows;
  }
  CHECK(last_closed == doctest::Approx(0.2).epsilon(0.05));
  CHECK(force / rows == doctest::Approx(1.0 * 10.0 * 1.0 * 0.01).epsilon(0.01));
}

TEST_SUITE_END();
