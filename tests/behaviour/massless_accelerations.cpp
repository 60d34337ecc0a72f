// Velocities and accelerations of nodes without mass: equilibrium, differentiated once and twice.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "behaviour/outputs.hpp"

namespace signorini::tests::outputs {
namespace {

const char* const all_engines_of_paper[] = {"exact", "ida", "newmark", "friction-iteration"};

std::string direction(double angle) {
  return fmt::format("[{:.17g}, {:.17g}]", std::cos(angle), std::sin(angle));
}

/// A mass of 2 on a line at `angle`, a spring of 300 to p, one of 100 from p to the ground. No mass at p.
/// k = 75, omega^2 = 37.5, u_p = 3/4 u_m.
std::string line(double angle) {
  const std::string along = direction(angle), across = direction(angle + 0.5 * std::numbers::pi);
  std::string text = fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
[run]
t_end = 2.0
output_dt = 0.01
initial = {{ m = {{ ux = {:.17g}, uy = {:.17g} }} }}
[nodes]
m = [0.0, 0.0]
p = [1.0, 0.0]
[[masses]]
node = "m"
mass = 2.0
)",
                                 0.1 * std::cos(angle), 0.1 * std::sin(angle));
  const auto spring = [&](const char* node, const char* more, const std::string& way, double k) {
    text += fmt::format("[[springs]]\nnode = \"{}\"\n{}direction = {}\nstiffness = {}\n", node, more, way, k);
  };
  spring("m", "against = \"p\"\n", along, 300.0);
  spring("p", "", along, 100.0);
  spring("m", "", across, 500.0);
  spring("p", "", across, 500.0);
  text +=
      fmt::format("[[contacts]]\nname = \"stop\"\nnode = \"m\"\nlaw = \"compliant\"\nnormal = {}\n", along) +
      "gap = 0.5\nnormal_stiffness = 1000.0\n";
  const auto at = [&](const char* name, const char* kind, const char* node) {
    text += output(name, kind, fmt::format("at = \"{}\"\ndirection = {}", node, along));
  };
  at("a_m", "acceleration", "m");
  at("a_p", "acceleration", "p");
  at("v_p", "velocity", "p");
  return text;
}

/// p without mass on a spring of 50 and a damper of 2, pushed by 4 sin 9t.
const char* const damped = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 1.0
output_dt = 0.01
[nodes]
m = [0.0, 0.0]
p = [1.0, 0.0]
[[masses]]
node = "m"
mass = 1.0
[[springs]]
node = "m"
direction = [0.6, 0.8]
stiffness = 10.0
[[springs]]
node = "m"
direction = [-0.8, 0.6]
stiffness = 10.0
[[springs]]
node = "p"
direction = [0.6, 0.8]
stiffness = 50.0
damping = 2.0
[[springs]]
node = "p"
direction = [-0.8, 0.6]
stiffness = 70.0
[[contacts]]
name = "stop"
node = "m"
law = "compliant"
normal = [1.0, 0.0]
gap = 0.5
normal_stiffness = 1000.0
[[loads]]
node = "p"
direction = [0.6, 0.8]
amplitude = 4.0
history = { type = "harmonic", omega = 9.0 }
)";

}  // namespace

TEST_SUITE_BEGIN("behaviour/massless_accelerations");

TEST_CASE("massless: a node between two springs has its part of the acceleration, at every angle") {
  const double omega = std::sqrt(37.5), most = 0.75 * 0.1 * 37.5;
  for (const std::string engine : all_engines_of_paper)
    for (const double angle : {0.0, 0.3, 1.9, -2.6}) {
      CAPTURE(engine);
      CAPTURE(angle);
      const Computed c = compute(line(angle), engine);
      // newmark's period is longer by (omega h)^2/12: at the end off by omega t (omega h)^2 / 12 < 4e-7.
      const double tolerance = engine == "exact" ? 1e-11 : engine == "ida" ? 2e-8 : 1e-6;
      const std::size_t a = c.index("a_p"), v = c.index("v_p");
      for (const auto& row : c.result.responses) {
        CAPTURE(row.t);
        CHECK(std::abs(row.values[a] + most * std::cos(omega * row.t)) < tolerance * most);
        CHECK(std::abs(row.values[v] + most / omega * std::sin(omega * row.t)) < tolerance * most);
      }
      CHECK(c.extremes("a_p").minimum == doctest::Approx(-most).epsilon(tolerance));
      CHECK(c.extremes("a_p").maximum == doctest::Approx(most).epsilon(tolerance));
      CHECK(c.extremes("v_p").maximum == doctest::Approx(most / omega).epsilon(tolerance));
    }
}

TEST_CASE("massless: the acceleration of a node on a damper") {
  const double k = 50.0, d = 2.0, F = 4.0, w = 9.0, size = F / (k * k + d * d * w * w);
  const std::string text = std::string(damped) +
                           output("a", "acceleration", "at = \"p\"\ndirection = [0.6, 0.8]") +
                           output("v", "velocity", "at = \"p\"\ndirection = [0.6, 0.8]");
  for (const std::string engine : all_engines_of_paper) {
    CAPTURE(engine);
    const Computed c = compute(text, engine);
    const double tolerance = engine == "exact" ? 1e-11 : engine == "ida" ? 1e-6 : 1e-5;
    for (const auto& row : c.result.responses) {
      const double t = row.t, rate = k / d, rest = size * d * w * std::exp(-rate * t);
      CAPTURE(t);
      const double v = size * w * (k * std::cos(w * t) + d * w * std::sin(w * t)) - rate * rest;
      const double a = size * w * w * (-k * std::sin(w * t) + d * w * std::cos(w * t)) + rate * rate * rest;
      CHECK(std::abs(row.values[c.index("v")] - v) < tolerance * F / d);
      CHECK(std::abs(row.values[c.index("a")] - a) < tolerance * F * w / d);
    }
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::outputs
