// Static starts of reduced models are in equilibrium to the rounding of the models' own numbers.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <array>
#include <cmath>

#include "contact/friction.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/model/reduce/reduced_start");

namespace {

/// A hot pipe with a loop on shoes that rub and a spring, turned by any angle.
std::string hot_pipe(const char* initial, double degrees, const char* more = "") {
  const double a = degrees * 0.017453292519943295, c = std::cos(a), s = std::sin(a);
  const auto at = [&](double x, double y) {
    return fmt::format("[{:.17g}, {:.17g}]", c * x - s * y, s * x + c * y);
  };
  std::string text = fmt::format(R"(schema = 1
units = {{ force = "kN", mass = "t", length = "m", time = "s" }}
gravity = {}
[run]
t_end = 0.2
initial = "{}"
output_dt = 0.01
engine = "exact"
certify = false
[damping]
ratios = [0.03, 0.03]
frequencies = [1.0, 20.0]
[reduction]
cutoff_frequency = 60.0
[sections.pipe]
pipe = {{ diameter = 0.273, wall = 0.00927, E = 2.0e8, density = 7.85, content = 1.0 }}
[nodes]
)",
                                 at(0.0, -9.81), initial);
  const std::pair<const char*, std::array<double, 2>> nodes[] = {
      {"A", {0.0, 0.0}},  {"S1", {7.0, 0.0}}, {"S2", {14.0, 0.0}}, {"B", {20.0, 0.0}}, {"C", {20.0, 4.0}},
      {"D", {26.0, 4.0}}, {"E", {26.0, 0.0}}, {"S3", {31.0, 0.0}}, {"F", {37.0, 0.0}}};
  for (const auto& [name, p] : nodes) text += fmt::format("{} = {}\n", name, at(p[0], p[1]));
  text += fmt::format(R"([[members]]
nodes = ["A", "S1", "S2", "B", "C", "D", "E", "S3", "F"]
section = "pipe"
elements = 3
thermal_expansion = 1.2e-5
temperature = 180.0
[[supports]]
node = "A"
fix = ["ux", "uy", "rz"]
[[contacts]]
name = "shoe"
nodes = ["S1", "S2", "S3", "F"]
law = "compliant"
normal = {}
normal_stiffness = 5.0e4
tangential_stiffness = 2.0e4
friction = 0.3
[[springs]]
node = "D"
direction = {}
stiffness = 40.0
)",
                      at(0.0, 1.0), at(0.0, -1.0));
  return text + more;
}

/// What is out of balance, and the greatest force along any shape.
std::pair<double, double> out_of_balance(const Model& model) {
  Vector r = -(model.stiffness * model.u0);
  double greatest = r.cwiseAbs().maxCoeff();
  for (const Load& load : model.loads)
    if (load.is_static) load.direction.add_to(r, load.history.value(0.0));
  for (const Contact& c : model.contacts) {
    c.normal.add_to(r, -c.normal_stiffness * std::min(0.0, c.gap_at(model.u0)));
    c.tangent.add_to(r, -c.initial_shear);
  }
  return {r.cwiseAbs().maxCoeff(), greatest};
}

}  // namespace

TEST_CASE("a hot pipe that friction holds is in equilibrium to rounding; shears at their limits stay there") {
  for (const double degrees : {0.0, 37.3}) {
    CAPTURE(degrees);
    const Model model = build_model(parse_scene(hot_pipe("frictional", degrees), "pipe.toml"));
    REQUIRE(model.reduction);
    const auto [off, greatest] = out_of_balance(model);
    CHECK(off <= 30.0 * 2.3e-16 * greatest);  // sums of some ten terms; 1e-11 of it were left
    int at_limit = 0, below = 0;
    for (const Contact& c : model.contacts) {
      const double N = c.normal_stiffness * std::abs(c.gap_at(model.u0)),
                   limit = contact::static_friction(c) * N;
      CHECK(std::abs(c.initial_shear) <= limit);
      (std::abs(c.initial_shear) >= limit * (1.0 - 1e-9) ? at_limit : below)++;
      // As near to its limit as the start was found.
      if (std::abs(c.initial_shear) >= limit * (1.0 - 1e-9))
        CHECK(std::abs(c.initial_shear) >= limit * (1.0 - 1e-11));
    }
    CHECK(at_limit > 0);
    CHECK(below > 0);
  }
}

TEST_CASE("a reduced pipe at rest stays at rest: no event, no warning of its shears, no break") {
  for (const double degrees : {0.0, 37.3}) {
    CAPTURE(degrees);
    const Scene scene = parse_scene(hot_pipe("frictional", degrees), "pipe.toml");
    const Result result = simulate(scene);
    CHECK(result.events.empty());
    CHECK(result.report.law_checks.violated == 0);
    for (const std::string& warning : result.report.warnings)
      CHECK_MESSAGE(warning.find("initial_shear") == std::string::npos, warning);
  }
}

TEST_CASE(
    "without friction in the start shears stay zero; a load that the start does not know stays out of it") {
  const Model still = build_model(parse_scene(hot_pipe("static", 12.0), "pipe.toml"));
  const auto [off, greatest] = out_of_balance(still);
  CHECK(off <= 30.0 * 2.3e-16 * greatest);
  for (const Contact& c : still.contacts) CHECK(c.initial_shear == 0.0);
  // Its jump at t = 0 is no part of the start.
  const Scene scene =
      parse_scene(hot_pipe("static", 12.0,
                           "[[loads]]\nnode = \"C\"\ndirection = [1.0, 0.0]\namplitude = 3.0\n"
                           "history = { type = \"step\", start = 0.0 }\n"),
                  "pipe.toml");
  const Model pushed = build_model(scene);
  CHECK(out_of_balance(pushed).first <= 30.0 * 2.3e-16 * greatest);
}

TEST_SUITE_END();
