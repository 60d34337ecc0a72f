#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "unit/engine/stretch.hpp"

namespace signorini::tests::ida_engines {
namespace {

/// A mass that leaves a rigid floor with a speed that lifts it by `height`, in a scene of this extent.
std::string hop(double height, double extent) {
  return fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
[run]
t_end = 1.0
engine = "ida"
rtol = 1e-8
initial = {{ u = [0.0, {1}], v = [{0}, 0.0] }}
[matrices]
mass = [[1.0, 0.0], [0.0, 1.0]]
stiffness = [[0.0, 0.0], [0.0, 100.0]]
[[contacts]]
name = "c"
law = "rigid"
normal = {{ d0 = 1.0 }}
restitution = 0.5
[[loads]]
direction = {{ d0 = -1.0 }}
amplitude = {2}
)",
                     std::sqrt(20.0 * extent * height), extent, 10.0 * extent);
}

}  // namespace

TEST_SUITE_BEGIN("unit/engine/ida/ida_engine");

TEST_CASE(
    "flights below the mean of tolerance and size are taken whole, others in steps, in any unit of length") {
  for (const double extent : {1e-4, 1.0, 1e4}) {
    CAPTURE(extent);
    Stretch probe(hop(extent, extent));
    const double size = probe.model.scales.displacement, tolerance = probe.tolerance.displacement;
    const double low = std::sqrt(tolerance * size);
    for (const double part : {0.03, 0.5, 3.0, 30.0}) {
      CAPTURE(part);
      const double height = part * low;
      Stretch stretch(hop(height, extent));
      long steps = 0;
      const Step last = stretch.go([&](const Step&) { ++steps; });
      REQUIRE(last.kind == Step::Kind::event);
      const double flight = 2.0 * std::sqrt(2.0 * height / (10.0 * extent));
      if (part < 1.0) {
        CHECK(steps == 1);
        CHECK(last.end == doctest::Approx(flight).epsilon(1e-12));
        CHECK(stretch.at(0.5 * flight).u[0] == doctest::Approx(height).epsilon(1e-12));
      } else {
        CHECK(steps > 1);
        CHECK(last.end == doctest::Approx(flight).epsilon(1e-2));
      }
    }
  }
}

TEST_CASE(
    "a free oscillator between ends of steps, its acceleration and its residual, within the tolerance") {
  Stretch stretch(hop(1.0, 1.0), {{"run.t_end", "0.8"}});
  const Step last = stretch.go([&](const Step& step) {
    for (const double x : {0.0, 0.3, 0.8, 1.0}) {
      const double t = step.begin + x * (step.end - step.begin);
      const Point p = stretch.at(t);
      CHECK(std::abs(p.u[1] - std::cos(10.0 * t)) < 2e-6);
      CHECK(std::abs(p.v[1] + 10.0 * std::sin(10.0 * t)) < 2e-5);
      CHECK(std::abs(p.a[1] + 100.0 * p.u[1]) < 1e-12 * 100.0);
      CHECK(std::abs(p.a[0] + 10.0) < 1e-13);
    }
    CHECK(stretch.engine->residual() < 1e-3);
  });
  CHECK(last.kind == Step::Kind::accepted);
  CHECK(last.end == 0.8);
  // One tolerance of the guard's value.
  ContactMotion m;
  m.gap = 3.0;
  Form gap;
  gap.gap = 1.0;
  const double error = stretch.tolerance.rtol * 3.0 + stretch.tolerance.displacement;
  CHECK(stretch.engine->guard_error(gap, m, 0) >= error);
  CHECK(stretch.engine->guard_error(gap, m, 0) < 1e3 * error);
}

TEST_SUITE_END();

}  // namespace signorini::tests::ida_engines
