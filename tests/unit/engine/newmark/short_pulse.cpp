// Impulses that steps of average acceleration pass on.
#include "engine/newmark/newmark_step.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "behaviour/scene_parts.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::short_pulse {
namespace {

using namespace parts;

constexpr double dt = 0.01;

/// A free mass of 1 under a load from 0.103 on.
std::string scene_text(const std::string& history, const std::string& engine) {
  return head + fmt::format("[run]\nt_end = 0.5\nengine = \"{}\"\ndt = {}\n", engine, dt) +
         nodes({{"A", 0, 0}}) + point_mass("A", 1.0) + fixed("A", "uy, rz") +
         "[[loads]]\nnode = \"A\"\ndirection = [1.0, 0.0]\namplitude = 10.0\nhistory = " + history + "\n";
}

/// Whether `v` is what the impulse makes, within this part of it.
void check_impulse(const std::string& history, double impulse, double part) {
  for (const char* engine : {"newmark", "friction-iteration"}) {
    CAPTURE(history);
    CAPTURE(engine);
    const Scene s = parse_scene(scene_text(history, engine), "test.toml");
    const Result result = simulate(build_model(s), s.run);
    REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
    CHECK(result.rows.back().v[0] == doctest::Approx(impulse).epsilon(part));
    for (const std::string& warning : result.report.warnings)
      CHECK(warning.find("its phase advances") == std::string::npos);
  }
}

long steps_of(const std::string& history) {
  const Scene s = parse_scene(scene_text(history, "newmark"), "test.toml");
  return simulate(build_model(s), s.run).report.counters.steps;
}

}  // namespace

TEST_SUITE_BEGIN("unit/engine/newmark/short_pulse");

TEST_CASE("a half sine passes its impulse on, however short beside dt") {
  for (const double duration : {1e-13, 1e-9, 1e-5, 1e-3, 5e-3, 0.01, 0.012, 0.02, 0.03})
    check_impulse(fmt::format("{{ type = \"half_sine\", start = 0.103, duration = {} }}", duration),
                  20.0 / M_PI * (0.103 + duration - 0.103), 1e-4);
}

TEST_CASE("a pulse that fits a few steps is left to dt, whose trapezoidal rule is of second order") {
  for (const double duration : {0.05, 0.08, 0.16, 0.24})
    check_impulse(fmt::format("{{ type = \"half_sine\", start = 0.1, duration = {} }}", duration),
                  20.0 / M_PI * duration, std::pow(M_PI * dt / duration, 2) / 11.0);
  // 50 steps, wherever the breakpoints are multiples of dt
  CHECK(steps_of("{ type = \"half_sine\", start = 0.1, duration = 0.05 }") == 50);
}

TEST_CASE(
    "where dt is left alone its own steps lose a sixteenth of the impulse at most, whatever the wave and the "
    "stretch") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  Model model;
  model.loads.resize(1);
  int left = 0, parted = 0;
  for (int i = 0; i < 400; ++i) {
    Piece piece;
    piece.coefficients = {any(random) - 0.5, 20.0 * (any(random) - 0.5)};
    piece.amplitude = 2.0 * any(random);
    piece.omega = std::pow(10.0, 4.0 * any(random));
    piece.phase = 6.0 * any(random);
    model.loads[0].history = History(piece);
    const double begin = any(random), end = begin + 16.0 * dt * std::pow(any(random), 3);
    CAPTURE(piece.omega);
    CAPTURE((end - begin) / dt);
    const double h = newmark::segment_step_length(model, begin, end, dt);
    const auto rule = [&](double step) {
      double sum = 0.0;
      for (double t = begin; t < end;) {
        const double next = std::min(end, t + step);
        sum += 0.5 * (next - t) * (piece.value(t) + piece.value(next));
        t = next;
      }
      return sum;
    };
    double size = 0.0, impulse = 0.0;
    const int parts = 20000;
    for (int k = 0; k < parts; ++k) {
      const double f = piece.value(begin + (end - begin) * (k + 0.5) / parts);
      impulse += f * (end - begin) / parts;
      size += std::abs(f) * (end - begin) / parts;
    }
    if (piece.omega * (end - begin) > 100.0) continue;  // faster than the finest parts tell
    (h == dt ? left : parted) += 1;
    CHECK(std::abs(rule(h) - impulse) <= (h == dt ? 1.001 / 16.0 : 2e-4) * size);
  }
  CHECK(left > 150);
  CHECK(parted > 20);
}

TEST_CASE("polynomials and bursts that vanish where they begin and end") {
  // 10 (s/T - (s/T)^2), 10 (s^2/T^2 - s^3/T^3) (steps of a table end at its rows, but not those of this)
  check_impulse(
      "{ type = \"polynomial\", start = 0.103, end = 0.105, coefficients = [0.0, 500.0, -250000.0] }",
      10.0 * 2e-3 / 6.0, 1e-4);
  check_impulse(
      "{ type = \"polynomial\", start = 0.103, end = 0.105, coefficients = [0.0, 0.0, 250000.0, "
      "-125000000.0] }",
      10.0 * 2e-3 / 12.0, 1e-3);
  // three half waves: one is left
  check_impulse(fmt::format("{{ type = \"harmonic\", start = 0.103, end = 0.109, omega = {} }}", M_PI / 2e-3),
                20.0 / M_PI * 2e-3, 1e-3);
}

TEST_CASE("tables keep the steps of dt, straight or smooth, whose rows are denser or not") {
  const auto table = [](const char* interpolation) {
    return fmt::format(
        "{{ type = \"table\", times = [0.1, 0.102, 0.104, 0.11, 0.13, 0.14], values = [0, 1, 0.5, 2, "
        "1, 0], interpolation = \"{}\" }}",
        interpolation);
  };
  CHECK(steps_of(table("linear")) == steps_of(table("steffen")));
  CHECK(steps_of(table("linear")) == 52);  // 0.102 and 0.104 are two more
}

TEST_CASE("a load that swings within steps is named") {
  const auto warnings = [](double omega) {
    const Scene s = parse_scene(
        scene_text(fmt::format("{{ type = \"harmonic\", start = 0.0, omega = {} }}", omega), "newmark"),
        "test.toml");
    return simulate(build_model(s), s.run).report.warnings;
  };
  CHECK(warnings(99.0).empty());
  REQUIRE(warnings(150.0).size() == 1);
  CHECK(warnings(150.0)[0].find("the phase of 'load 1' advances by 1.5 rad in a step of run.dt = 0.01") == 0);
}

TEST_SUITE_END();

}  // namespace signorini::tests::short_pulse
