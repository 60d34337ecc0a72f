// What happens at one instant, whatever rounding makes of its time: every history goes on with its next piece.
//
//   m v' = f(t): v(t_end) = impulse / m
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <string>
#include <vector>

#include "behaviour/scene_parts.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::one_instant {
namespace {

using namespace parts;

/// A mass that is free along x, under loads along x with these histories: its velocity at the end.
double velocity(double t_end, const std::vector<std::string>& histories, const std::string& engine) {
  std::string text =
      head + run_table(t_end, t_end) + nodes({{"A", 0, 0}}) + point_mass("A", 1.0) + fixed("A", "uy, rz");
  for (const std::string& history : histories)
    text += "[[loads]]\nnode = \"A\"\ndirection = [1.0, 0.0]\n" + history +
            (history.find("amplitude") == std::string::npos ? "\namplitude = 1.0\n" : "\n");
  const Scene scene =
      parse_scene(text, "test.toml", {{"run.engine", engine}, {"run.dt", "1e-2"}, {"run.certify", "false"}});
  const Result result = simulate(build_model(scene), scene.run);
  CHECK(result.report.outcome.kind == Outcome::Kind::done);
  return result.rows.back().v[0];
}

const std::vector<std::string> engines{"exact", "ida", "newmark"};
double tolerance_of(const std::string& engine) { return engine == "exact" ? 1e-13 : 1e-7; }

}  // namespace

TEST_SUITE_BEGIN("behaviour/one_instant");

TEST_CASE("a pulse that lasts its whole period is in force all the time") {
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const double v = velocity(
        1.6, {"history = { type = \"rectangle\", start = 0.3, end = 0.5, period = 0.2, shift = -0.05 }"},
        engine);
    CHECK(v == doctest::Approx(1.6 - 0.25).epsilon(tolerance_of(engine)));
  }
}

TEST_CASE("a record that is repeated gives its impulse as often as it is repeated") {
  // Periods that are no sums of powers of two, whole rounds: the area of a triangle each.
  for (const double period : {0.07, 0.11, 0.6, 0.31, 0.357, 0.0123})
    for (const double peak : {0.25, 0.77}) {
      const int rounds = 43;
      CAPTURE(period);
      const double v =
          velocity(period * rounds,
                   {fmt::format("history = {{ type = \"table\", times = [0.0, {}, {}], values = [0.0, 1.0, "
                                "0.0], period = {} }}",
                                peak * period, period, period)},
                   "exact");
      CHECK(v == doctest::Approx(0.5 * period * rounds).epsilon(1e-12));
    }
}

TEST_CASE("a load begins where another ends, though the sum of its times is another double") {
  const std::string rectangle =
      "history = { type = \"rectangle\", start = 0.1, end = 0.30000000000000004 }";  // 0.1 + 0.2
  const std::string step = "history = { type = \"step\", start = 0.3 }\namplitude = 2.0";
  const std::string late = "history = { type = \"step\", start = 0.1, shift = 0.2 }\namplitude = 2.0";
  const std::string early = "history = { type = \"rectangle\", start = 0.1, end = 0.3 }";
  for (const std::string& engine : engines)
    for (const auto& pair : {std::vector{rectangle, step}, {step, rectangle}, {late, early}, {early, late}}) {
      CAPTURE(engine);
      CAPTURE(pair[0]);
      CHECK(velocity(1.6, pair, engine) == doctest::Approx(0.2 + 2.6).epsilon(tolerance_of(engine)));
    }
}

TEST_CASE("a table that rises within the clock's resolution jumps") {
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    CHECK(velocity(1.6,
                   {"history = { type = \"table\", times = [0.0, 0.85, 0.8500000000000111, 1.6], values = "
                    "[1, 1, 3, 3] }"},
                   engine) == doctest::Approx(0.85 + 3.0 * 0.75).epsilon(tolerance_of(engine)));
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::one_instant
