// What supports bear (Report::supports): signs, times, residual slip, against closed forms.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <string>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

/// A block of 1 kg on a plate that presses it with 10 N; 6 N push it along (c, s) from 0.5 s to 1 s.
std::string push(double c, double s, const char* units, double force, double mass, double length) {
  return fmt::format(R"(schema = 1
units = {}
[run]
t_end = 2.0
output_dt = 0.5
[nodes]
block = [0.0, 0.0]
[[masses]]
node = "block"
mass = {}
[[contacts]]
name = "plate"
node = "block"
law = "slider"
tangent = [{}, {}]
normal_force = {}
friction = 0.3
[[springs]]
node = "block"
direction = [{}, {}]
stiffness = {}
[[loads]]
node = "block"
direction = [{}, {}]
amplitude = {}
history = {{ type = "rectangle", start = 0.5, end = 1.0 }}
)",
                     units, 1.0 * mass, c, s, 10.0 * force, -s, c, 1e4 * force / length, c, s, 6.0 * force);
}

}  // namespace

TEST_SUITE("behaviour/support_loads") {
  TEST_CASE("support loads: a pushed block, by hand, turned, mirrored and in other units") {
    struct Variant {
      double c, s;
      const char* units;
      double force, mass, length;
    };
    const double angle = 0.7391;
    for (const Variant& v :
         {Variant{1.0, 0.0, R"({ force = "N", mass = "kg", length = "m", time = "s" })", 1, 1, 1},
          Variant{std::cos(angle), std::sin(angle),
                  R"({ force = "N", mass = "kg", length = "m", time = "s" })", 1, 1, 1},
          Variant{-1.0, 0.0, R"({ force = "N", mass = "t", length = "mm", time = "s" })", 1, 1e-3, 1e3}})
      for (const char* engine : {"exact", "ida"}) {
        CAPTURE(v.units);
        CAPTURE(engine);
        const Scene scene =
            parse_scene(push(v.c, v.s, v.units, v.force, v.mass, v.length), "push", {{"run.engine", engine}});
        const Result result = simulate(scene);
        REQUIRE(result.report.supports.size() == 1);
        const SupportLoad& load = result.report.supports[0];
        CHECK(load.min_N.value == doctest::Approx(-10.0));
        CHECK(load.max_N.value == doctest::Approx(-10.0));
        CHECK(load.min_N.t == 0.0);
        // It slides at 0.5 s under its limit, which is its friction; before and behind it bears nothing.
        CHECK(load.max_T.value == doctest::Approx(3.0));
        CHECK(load.max_T.t == doctest::Approx(0.5));
        CHECK(std::abs(load.min_T.value) < 1e-9);
        // 3 m/s^2 for 0.5 s, and as long back to rest: 0.75 m.
        CHECK(load.residual_slip() == doctest::Approx(0.75 * v.length).epsilon(1e-6));
      }
  }

  TEST_CASE("support loads: the greatest compression of a block that falls onto a spring, and when") {
    const double g = 9.81, m = 1.7, k = 3100.0, h = 0.013;
    const std::string text = fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
gravity = [0.0, -{}]
[run]
t_end = 0.2
output_dt = 0.1
[nodes]
block = [0.0, 0.0]
[[masses]]
node = "block"
mass = {}
[[supports]]
node = "block"
fix = ["ux"]
[[contacts]]
name = "floor"
node = "block"
law = "compliant"
normal = [0.0, 1.0]
gap = {}
normal_stiffness = {}
)",
                                         g, m, h, k);
    // x'' = g - w^2 x from x = 0, x' = v: x = g / w^2 + A sin(w s - p).
    const double w = std::sqrt(k / m), v = std::sqrt(2.0 * g * h), still = g / (w * w);
    const double greatest = still + std::hypot(still, v / w);
    const double time = std::sqrt(2.0 * h / g) + (0.5 * std::numbers::pi + std::atan2(still, v / w)) / w;
    for (const char* engine : {"exact", "ida"}) {
      CAPTURE(engine);
      const Result result = simulate(parse_scene(text, "fall", {{"run.engine", engine}}));
      REQUIRE(result.report.supports.size() == 1);
      const SupportLoad& load = result.report.supports[0];
      CHECK(load.min_N.value == doctest::Approx(-k * greatest).epsilon(1e-7));
      CHECK(load.min_N.t ==
            doctest::Approx(time).epsilon(1e-4));  // where it turns, time is as the root of the value
      CHECK(load.max_N.value <= 1e-9 * k * greatest);
      CHECK(load.min_N.value == doctest::Approx(-result.report.peaks[0].N).epsilon(1e-12));
      CHECK(load.min_T.value == 0.0);
    }
  }
}
