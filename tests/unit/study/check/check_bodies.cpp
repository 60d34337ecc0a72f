// What check says of bodies and seams, beside computations by hand.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <numbers>

#include "study/check/check.hpp"

using namespace signorini;

namespace signorini::tests::check_bodies {
namespace {

Scene body_scene(const std::string& text) {
  return parse_scene(
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n" + text,
      "bodies.toml");
}

/// A strip 2 x 0.5, held at its left end; its other nodes move along it alone.
std::string strip(int along, const std::string& mass) {
  return fmt::format(R"(run = {{ t_end = 0.1 }}
[[bodies]]
name = "strip"
rectangle = {{ size = [2.0, 0.5] }}
elements = [{}, 1]
E = 8.0e6
nu = 0.0
density = 2000.0
thickness = 0.1
mass = "{}"
plane = "stress"
[[supports]]
nodes = ["strip.left"]
fix = ["ux"]
[[supports]]
nodes = ["strip.bottom", "strip.top"]
fix = ["uy"]
)",
                     along, mass);
}

}  // namespace

TEST_SUITE_BEGIN("unit/study/check/check_bodies");

TEST_CASE("frequencies of a strip are those of a chain of bars, its highest one and the cost follow") {
  // k h = (2 j - 1) pi / (2 n):  omega^2 = (c/h)^2 6 (1 - cos kh)/(2 + cos kh) consistent, 2 (1 - cos kh) lumped
  const double c = std::sqrt(8.0e6 / 2000.0);
  for (const std::string mass : {"consistent", "lumped"})
    for (const int n : {3, 10}) {
      CAPTURE(mass);
      CAPTURE(n);
      const Scene scene = body_scene(strip(n, mass));
      const check::CheckReport report = check::check(scene, build_model(scene));
      CHECK(report.degrees_of_freedom == 2 * n);
      const double h = 2.0 / n, kh = std::numbers::pi / (2.0 * n), cos = std::cos(kh);
      const double omega =
          c / h * std::sqrt(mass == "lumped" ? 2.0 * (1.0 - cos) : 6.0 * (1.0 - cos) / (2.0 + cos));
      REQUIRE(!report.open.modes.empty());
      CHECK(report.open.modes[0].omega == doctest::Approx(omega).epsilon(1e-10));
      REQUIRE(report.mass);
      CHECK(report.mass->total == doctest::Approx(2000.0 * 0.1).epsilon(1e-12));
      CHECK(report.mass->x == doctest::Approx(1.0).epsilon(1e-12));
      CHECK(report.mass->y == doctest::Approx(0.25).epsilon(1e-12));
    }
}

TEST_CASE("the highest frequency of one element: its two motions along x by hand") {
  // Ends of the right edge alike: omega^2 = 3 E/(rho L^2); opposite: 9 (E/(3 L^2) + G/H^2)/rho, G = E/2: the incompatible modes
  // take the part of the shear that grows along x.
  const double E = 8.0e6, rho = 2000.0, L = 2.0, H = 0.5;
  const Scene scene = body_scene(strip(1, "consistent"));
  const check::CheckReport report = check::check(scene, build_model(scene));
  REQUIRE(report.open.modes.size() == 2);
  CHECK(report.open.modes[0].omega == doctest::Approx(std::sqrt(3.0 * E / (rho * L * L))).epsilon(1e-10));
  const double highest = std::sqrt(9.0 * (E / (3.0 * L * L) + 0.5 * E / (H * H)) / rho);
  CHECK(report.open.modes[1].omega == doctest::Approx(highest).epsilon(1e-10));
  CHECK(report.cost.omega_max == doctest::Approx(highest).epsilon(1e-6));
}

TEST_CASE("mesh quality in check --json: angles and edges of the worst elements of a graded ring, by hand") {
  // Four elements of 22.5 degrees across, the outer ring longer: chords 2 r sin(11.25 deg), radii 1 and 2.
  const Scene scene = body_scene(R"(run = { t_end = 0.1 }
[[bodies]]
name = "ring"
ring = { inner = 1.0, outer = 2.0, degrees = [10.0, 100.0] }
elements = [1, 4]
E = 8.0e6
nu = 0.2
density = 2000.0
plane = "strain"
[[supports]]
nodes = ["ring.outer"]
fix = ["ux", "uy"]
)");
  const Model model = build_model(scene);
  const auto json = nlohmann::json::parse(check::check_json(scene, model, check::check(scene, model)));
  const auto& body = json.at("bodies").at(0);
  CHECK(body.at("least_angle").at("value").get<double>() == doctest::Approx(90.0 - 11.25).epsilon(1e-9));
  CHECK(body.at("greatest_angle").at("value").get<double>() == doctest::Approx(90.0 + 11.25).epsilon(1e-9));
  const double inner = 2.0 * std::sin(11.25 * std::numbers::pi / 180.0);
  CHECK(body.at("aspect").at("value").get<double>() == doctest::Approx(1.0 / inner).epsilon(1e-9));
}

TEST_CASE("a seam that slides at its limit and flutters: the warning has the rate of each node by hand") {
  // Two nodes of a surface, each a mass m on [[a, c], [c, b]]; the seam gives each its D = L/2 of stiffness, kn. Slipping,
  // K = [[a, c - f kn], [c, b + kn]]: m lambda^2 = -(mean +- sqrt(half^2 + c (c - f kn))), a pair of complex numbers.
  const double a = 1000.0, b = 20.0, c = 30.0, f = 0.4, kn = 1000.0, m = 2.0;
  const double mean = 0.5 * (a + b + kn), half = 0.5 * (b + kn - a);
  const double turn = std::sqrt(-(half * half + c * (c - f * kn)));
  const std::complex<double> lambda = std::sqrt(-std::complex<double>(mean, turn) / m);
  const std::string expected =
      fmt::format("an oscillation of {:.4g} rad/s grows like exp({:.4g} t) (flutter)",
                  std::abs(lambda.imag()), std::abs(lambda.real()));
  for (const double degrees : {0.0, 37.0})
    for (const double push : {100.0, -100.0}) {
      CAPTURE(degrees);
      CAPTURE(push);
      const double x = std::cos(degrees * std::numbers::pi / 180.0),
                   y = std::sin(degrees * std::numbers::pi / 180.0);
      const double xx = x * x * a + y * y * b - 2.0 * x * y * c, yy = y * y * a + x * x * b + 2.0 * x * y * c;
      const double xy = x * y * (a - b) + (x * x - y * y) * c;
      const double px = push * x + 100.0 * y, py = push * y - 100.0 * x;  // pushed along, pressed
      const Scene scene = body_scene(fmt::format(
          R"(run = {{ t_end = 1.0, initial = "frictional" }}
[matrices]
dofs = ["px", "py", "qx", "qy"]
mass = [[{0}, 0.0, 0.0, 0.0], [0.0, {0}, 0.0, 0.0], [0.0, 0.0, {0}, 0.0], [0.0, 0.0, 0.0, {0}]]
stiffness = [[{1:.17g}, {2:.17g}, 0.0, 0.0], [{2:.17g}, {3:.17g}, 0.0, 0.0], [0.0, 0.0, {1:.17g}, {2:.17g}], [0.0, 0.0, {2:.17g}, {3:.17g}]]
[[surfaces]]
name = "edge"
x = [0.0, {4:.17g}]
y = [0.0, {5:.17g}]
ux = ["px", "qx"]
uy = ["py", "qy"]
[[seams]]
name = "belt"
slave = "edge"
master = "ground"
law = "compliant"
normal_stiffness = {6}
tangential_stiffness = {6}
friction = {7}
[[loads]]
direction = {{ px = {8:.17g}, py = {9:.17g}, qx = {8:.17g}, qy = {9:.17g} }}
amplitude = 1.0
)",
          m, xx, xy, yy, 4.0 * x, 4.0 * y, kn / 2.0, f, px, py));
      const std::vector<std::string> warnings = check::check(scene, build_model(scene)).warnings;
      const bool told = std::any_of(warnings.begin(), warnings.end(), [&](const std::string& warning) {
        return warning.find("the slip of contacts 'belt.1' and 'belt.2'") != std::string::npos &&
               warning.find(expected) != std::string::npos;
      });
      // Dragged back c (c + f kn) > 0: no flutter.
      CHECK(told == (push > 0.0));
    }
}

TEST_SUITE_END();

}  // namespace signorini::tests::check_bodies
