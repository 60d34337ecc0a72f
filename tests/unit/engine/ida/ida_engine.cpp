#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "behaviour/one_mass.hpp"
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
      const engine::Step last = stretch.go([&](const engine::Step&) { ++steps; });
      REQUIRE(last.kind == engine::Step::Kind::event);
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
  const engine::Step last = stretch.go([&](const engine::Step& step) {
    for (const double x : {0.0, 0.3, 0.8, 1.0}) {
      const double t = step.begin + x * (step.end - step.begin);
      const motion::Point p = stretch.at(t);
      CHECK(std::abs(p.u[1] - std::cos(10.0 * t)) < 2e-6);
      CHECK(std::abs(p.v[1] + 10.0 * std::sin(10.0 * t)) < 2e-5);
      CHECK(std::abs(p.a[1] + 100.0 * p.u[1]) < 1e-12 * 100.0);
      CHECK(std::abs(p.a[0] + 10.0) < 1e-13);
    }
    CHECK(stretch.engine->dense_output().residual() < 1e-3);
  });
  CHECK(last.kind == engine::Step::Kind::accepted);
  CHECK(last.end == 0.8);
  // One tolerance of the guard's value.
  ContactMotion m;
  m.gap = 3.0;
  Form gap;
  gap.gap = 1.0;
  const double error = stretch.tolerance.rtol * 3.0 + stretch.tolerance.displacement;
  CHECK(stretch.engine->guard_error({Guard::closing, gap}, m, 0) >= error);
  CHECK(stretch.engine->guard_error({Guard::closing, gap}, m, 0) < 1e3 * error);
}

TEST_CASE("a friction force within its own error opens from stick; one beyond it slips first") {
  // A mass lands on a damped spring at 2 m/s, with a slip rate v beside it; turned by an odd angle. It sticks:
  // T = kt v / w sin(w t), w = sqrt(kt / m), and opens at t = 0.022 s, where N falls at 7.6e4 N/s. So the limit is
  // reached |T| / (0.3 N') = 4.7e-3 |v| s/(m/s) before.
  const auto lands = [](double slip_rate, const char* engine) {
    const double c = std::cos(0.6435), s = std::sin(0.6435), t = slip_rate;
    return run_text(
        matrix_scene(
            fmt::format(
                "t_end = 0.05\noutput_dt = 0.05\ninitial = {{ u = [{}, {}], v = [{:.17g}, {:.17g}] }}",
                0.02 * c, 0.02 * s, -2.0 * c + t * s, -2.0 * s - t * c),
            "mass = [[2.0, 0.0], [0.0, 2.0]]\nstiffness = [[0.0, 0.0], [0.0, 0.0]]",
            fmt::format("law = \"compliant\"\nnormal = {{ d0 = {0:.17g}, d1 = {1:.17g} }}\ntangent = {{ d0 = "
                        "{1:.17g}, d1 = {2:.17g} }}\nnormal_stiffness = 4e4\ntangential_stiffness = 3e4\n"
                        "normal_damping = 10.0\nfriction = 0.3",
                        c, s, -c)),
        engine, "1e-9");
  };
  for (const double slip_rate : {1e-9, -1e-9, 1e-4, -1e-4}) {
    CAPTURE(slip_rate);
    const bool told = std::abs(slip_rate) > 1e-6;
    const Result truth = lands(slip_rate, "exact"), run = lands(slip_rate, "ida");
    REQUIRE(truth.events.size() == 3);
    REQUIRE(run.events.size() == (told ? 3 : 2));
    const double early = truth.events[2].t - truth.events[1].t;
    CHECK(early == doctest::Approx(4.7e-3 * std::abs(slip_rate)).epsilon(0.02));
    const Event& last = run.events.back();
    CHECK(last.to == State::open);
    CHECK(last.from == (!told ? State::stick : slip_rate > 0.0 ? State::slip_plus : State::slip_minus));
    CHECK(std::abs(last.t - truth.events[2].t) < 1e-8);
    if (told) CHECK(std::abs(run.events[1].t - truth.events[1].t) < 1e-8);
    if (!told) CHECK(early < *last.t_uncertainty);
    CHECK(run.report.law_checks.violated == 0);
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::ida_engines
