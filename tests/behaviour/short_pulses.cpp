// Pulses that are far shorter than anything else in a scene: only their impulse counts.
//
//   m u'' + k u = f,  int f = J about t_0:   u = J sin(w (t - t_0)) / (m w)
#include <doctest/doctest.h>

#include <cmath>

#include "base/rounding.hpp"
#include "behaviour/scene_parts.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::short_pulses {
namespace {

using namespace parts;

/// A mass of 1 along x on a spring of 100; an impulse of J from 0.1 to `end`.
std::string struck(const std::string& run, double J, const std::string& type, double end,
                   const std::string& more = "") {
  const double area = type == "half_sine" ? 2.0 / M_PI : type == "triangle" ? 0.5 : 1.0;
  return head + "[run]\nt_end = 1.0\n" + run + nodes({{"A", 0, 0}}) + point_mass("A", 1.0) +
         fixed("A", "uy, rz") + spring("A", "[1.0, 0.0]", 100.0) + more +
         fmt::format(
             "[[loads]]\nnode = \"A\"\ndirection = [1.0, 0.0]\namplitude = {}\nhistory = {{ type = \"{}\", "
             "start = 0.1, "
             "end = {} }}\n",
             J / (area * (end - 0.1)), type, end);
}

Result run_of(const std::string& text) {
  const Scene scene = parse_scene(text, "test.toml");
  return simulate(build_model(scene), scene.run);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/short_pulses");

TEST_CASE("an oscillator that is struck: the swing of the impulse, in any time") {
  for (const char* engine : {"ida", "exact", "newmark"})
    for (const char* type : {"rectangle", "triangle", "half_sine"})
      for (const double duration : {1e-4, 1e-6, 1e-9, 1e-11, 1e-12}) {
        CAPTURE(engine);
        CAPTURE(type);
        CAPTURE(duration);
        const double end = 0.1 + duration, since = 1.0 - 0.5 * (0.1 + end);
        const Result result =
            run_of(struck(fmt::format("engine = \"{}\"\ndt = 1e-4\n", engine), 1.0, type, end));
        CHECK(result.report.outcome.kind == Outcome::Kind::done);
        CHECK(result.report.warnings.empty());
        // Half the pulse has another arm, of order (w d)^2; steps within it are known to some roundings of their times.
        const double clock = type[0] == 'r' ? 0.0 : rounding::many_operations * 0.1 / duration;
        const double off = 1e4 * duration * duration + clock + (engine[0] == 'n' ? 2e-4 : 1e-5);
        CHECK(std::abs(result.rows.back().u[0] - 0.1 * std::sin(10.0 * since)) <= 0.1 * off);
        CHECK(std::abs(result.rows.back().v[0] - std::cos(10.0 * since)) <= off);
        CHECK(result.report.audit.energy.value <= (1e-4 + clock) * result.report.audit.energy_scale);
      }
}

TEST_CASE("tolerances that miss the swing: the energy balance says so, however strong the pulse") {
  for (const double duration : {1e-5, 1e-9}) {
    CAPTURE(duration);
    const Result result =
        run_of(struck("engine = \"ida\"\natol = { displacement = 1.0, velocity = 10.0, force = 100.0 }\n",
                      1.0, "half_sine", 0.1 + duration));
    REQUIRE(result.report.warnings.size() == 1);
    CHECK(result.report.warnings[0].find("the energy balance has an error of ") == 0);
  }
}

TEST_CASE(
    "a slider whose friction depends on the rate: as many reversals after a short pulse as after a "
    "velocity") {
  const std::string contact =
      "[[contacts]]\nname = \"c\"\nnode = \"A\"\nlaw = \"slider\"\ntangent = [1.0, 0.0]\nnormal_force = 4.0\n"
      "friction = { slow = 0.1, fast = 0.3, velocity = 0.2 }\n";
  const auto events = [](const Result& result) {
    std::vector<double> times;
    for (const Event& e : result.events)
      if (e.t > 0.15) times.push_back(e.t);
    return times;
  };
  const std::vector<double> expected =
      events(run_of(struck("engine = \"ida\"\nrtol = 1e-11\n", 2.0, "rectangle", 0.1 + 1e-5, contact)));
  REQUIRE(expected.size() == 3);
  for (const double duration : {1e-6, 1e-7, 1e-8, 1e-9}) {
    CAPTURE(duration);
    const std::vector<double> found =
        events(run_of(struck("engine = \"ida\"\n", 2.0, "rectangle", 0.1 + duration, contact)));
    REQUIRE(found.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) CHECK(found[i] == doctest::Approx(expected[i]).epsilon(3e-5));
  }
}

TEST_CASE("times below the clock's resolution from the beginning are the beginning") {
  const std::string output =
      "[[output]]\nname = \"a\"\nkind = \"reaction\"\nat = \"A\"\ndirection = [0.0, 1.0]\n";
  for (const char* engine : {"ida", "exact", "newmark"})
    for (const char* history :
         {"{ type = \"rectangle\", start = 0.0, end = 0.01, period = 0.5, shift = 1e-200 }",
          "{ type = \"step\", start = 1e-30 }", "{ type = \"half_sine\", duration = 1e-200 }",
          "{ type = \"half_sine\", duration = 1e-17 }",
          "{ type = \"triangle\", start = 1e-150, end = 1e-100 }"}) {
      CAPTURE(engine);
      CAPTURE(history);
      const Result result =
          run_of(head + fmt::format("[run]\nt_end = 1.0\ndt = 1e-3\nengine = \"{}\"\n", engine) +
                 nodes({{"A", 0, 0}}) + point_mass("A", 1.0) + fixed("A", "uy, rz") +
                 spring("A", "[1.0, 0.0]", 100.0) +
                 "[[loads]]\nnode = \"A\"\ndirection = [1.0, 0.0]\namplitude = 1.0\nhistory = " + history +
                 "\n" + output);
      CHECK(result.report.outcome.kind == Outcome::Kind::done);
      if (history[10] == 's')  // the step
        CHECK(result.rows.back().u[0] == doctest::Approx(0.01 * (1.0 - std::cos(10.0))).epsilon(1e-3));
    }
  // A run that is no stretch at all.
  const Result nothing =
      run_of(head + "[run]\nt_end = 1e-150\n" + nodes({{"A", 0, 0}}) + point_mass("A", 1.0) +
             fixed("A", "uy, rz") + spring("A", "[1.0, 0.0]", 100.0) + output);
  CHECK(nothing.report.outcome.kind == Outcome::Kind::done);
}

TEST_SUITE_END();

}  // namespace signorini::tests::short_pulses
