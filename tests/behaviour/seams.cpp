// Seams in motion: a block that slides, two blocks that do not match.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "signorini/certify.hpp"
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
    CHECK(exact.report.law_checks.violated == 0);
    double most = 0.0;
    for (const auto& row : exact.rows) most = std::max(most, row.energy.kinetic + row.energy.elastic);
    for (const auto& row : exact.rows)
      CHECK(std::abs(row.energy.balance() - exact.rows.front().energy.balance()) <= 1e-9 * most);
    check_same_events(exact, simulate(seam_scene(pushed_blocks("exact", 33.7, mass))), 1e-10);
    const Result steps = simulate(seam_scene(pushed_blocks("ida", 0.0, mass)));
    check_same_events(exact, steps, 1e-6);
    CHECK(steps.report.law_checks.violated == 0);
  }
}

TEST_CASE(
    "a slow start of two blocks, turned as a whole by any angle: the same contact forces, and none fits") {
  std::vector<double> upright;
  for (const double degrees : {0.0, 90.0, 180.0, 270.0, 179.0, 33.7}) {
    CAPTURE(degrees);
    std::string text = pushed_blocks("exact", degrees, "none");
    text.replace(text.find("run = { "), 8, "run = { initial = \"frictional\", ");
    for (std::size_t at; (at = text.find("compliant")) != std::string::npos;) {
      text.replace(at, 9, "rigid");
      for (const char* key : {"normal_stiffness", "tangential_stiffness", "layer"})
        if (const std::size_t from = text.find(key, at); from < text.find("[[", at))
          text.erase(from, text.find('\n', from) - from);
    }
    const Model model = build_model(seam_scene(text));
    const StaticStart& start = model.statics;
    REQUIRE(start.stages.size() == 1);  // "fit" would be another
    double weight = 0.0;
    for (const double reaction : start.reactions) weight += reaction;
    CHECK(
        weight ==
        doctest::Approx(9.81 * (2.0 * (2500.0 * 0.3 * 0.2 * 0.1) + 2000.0 * 0.4 * 0.1 * 0.1)).epsilon(1e-8));
    if (upright.empty()) upright = start.reactions;
    REQUIRE(start.reactions.size() == upright.size());
    for (std::size_t k = 0; k < upright.size(); ++k)
      CHECK(std::abs(start.reactions[k] - upright[k]) <= 1e-7 * weight);
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

TEST_CASE(
    "a pipe at rest on nodes without mass: what is left of rounding breaks no law, and all is certain") {
  // Velocities are 1e-20 of what the push makes: roundings of places times frequencies.
  const Scene scene = seam_scene(R"(gravity = [0.0, -9.81]
run = { t_end = 0.056, engine = "exact", initial = "static", output_dt = 0.002, certify = true }
damping = { alpha = 0.0, beta = 2e-5 }
reduction = { cutoff_omega = 6000.0 }
base_motion = { direction = [1.0, 0.0], acceleration = { type = "half_sine", amplitude = 8.0, start = 0.05, duration = 0.2 } }
[[bodies]]
name = "saddle"
ring = { inner = 0.5, outer = 0.8, degrees = [200.0, 325.0] }
elements = [2, 15]
E = 3e10
nu = 0.2
density = 2400.0
plane = "strain"
[[bodies]]
name = "pipe"
ring = { inner = 0.48, outer = 0.5, degrees = [0.0, 360.0] }
elements = [1, 36]
shape = "q8"
E = 2e11
nu = 0.3
density = 20000.0
plane = "strain"
[[supports]]
nodes = ["saddle.outer"]
fix = ["ux", "uy"]
[[seams]]
name = "bed"
slave = "saddle.inner"
master = "pipe.outer"
law = "compliant"
layer = { E = 1e7, G = 3e6, thickness = 0.005 }
friction = 0.2
contact_mass = "none"
)");
  Result rows;
  const CertifiedReport run = simulate_certified(build_model(scene), scene.run, rows);
  const Report& report = run.report;
  CHECK(report.law_checks.checked > 20);
  CHECK(report.law_checks.violated == 0);
  CHECK(report.outcome.kind == Outcome::Kind::done);
  REQUIRE(run.certificate);
  CHECK(run.certificate->until == doctest::Approx(0.056).epsilon(1e-12));
}

TEST_SUITE_END();
