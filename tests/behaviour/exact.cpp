// What only the exact flow can promise: grazes down to rounding, hidden oscillations, sharp event times.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "behaviour/one_mass.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

/// x = -cos t above a stop at x = 1 - depth: touches it for 2 sqrt(2 depth) around t = pi.
Result graze(double depth, const std::string& engine) {
  return run_text(
      matrix_scene("t_end = 6.0\ninitial = { u = [1.0], v = [0.0] }", "mass = [[1.0]]\nstiffness = [[1.0]]",
                   fmt::format("law = \"compliant\"\nnormal = {{ d0 = 1.0 }}\nnormal_stiffness = "
                               "1.0\ngap = {:.17g}",
                               1.0 - depth)),
      engine);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/exact");

TEST_CASE("grazes from 1e-2 down to 1e-13 of the amplitude: found with the width they have, and none above") {
  for (int digits = 2; digits <= 13; ++digits) {
    CAPTURE(digits);
    const double depth = std::pow(10.0, -digits);
    const Result hit = graze(depth, "exact");
    REQUIRE(hit.events.size() == 2);
    // enters at cos t = depth - 1
    const double enter = std::numbers::pi - 2.0 * std::asin(std::sqrt(0.5 * depth));
    const double off = *hit.events[0].t_uncertainty;
    CHECK(std::abs(hit.events[0].t - enter) < std::max(off, 1e-14));
    CHECK(off < 1e-12 / std::sqrt(depth));
    CHECK(graze(-depth, "exact").events.empty());
  }
}

TEST_CASE("a graze within rounding is reported as undecidable") {
  const Result result = graze(0.0, "exact");
  REQUIRE(!result.report.warnings.empty());
  CHECK(result.report.warnings[0].find("cannot decide") != std::string::npos);
  for (const Result::Row& row : result.rows)
    CHECK(row.u[0] == doctest::Approx(std::cos(row.t)).epsilon(1e-12));
}

TEST_CASE("a slow guard with a fast small oscillation on it: the first of its many crossings") {
  // g = 1 + x + 1e-3 y-ish: d0 falls slowly through the stop, d1 shakes it at 1000 rad/s
  const Result result = run_text(
      matrix_scene("t_end = 1.2\ninitial = { u = [1.0, 1e-3], v = [-1.0, 0.0] }",
                   "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[0.0, 0.0], [0.0, 1e6]]",
                   "law = \"slider\"\ntangent = { d0 = 1.0, d1 = 1.0 }\nfriction = 0.0\nnormal_force = 1.0",
                   "[[contacts]]\nname = \"stop\"\nlaw = \"compliant\"\nnormal = { d0 = 1.0, d1 = 1.0 }\n"
                   "normal_stiffness = 1e-9\n"),
      "exact");
  // g = 1 - t + 1e-3 cos(1000 t): the first zero, by bisection from the first crest whose trough is below
  double first = 0.0;
  for (int i = 0; i < 4000000 && first == 0.0; ++i) {
    const double t = 0.99 + i * 1e-8;
    if (1.0 - t + 1e-3 * std::cos(1000.0 * t) < 0.0) first = t;
  }
  REQUIRE(!result.events.empty());
  CHECK(result.events[0].type == EventType::contact);
  CHECK(std::abs(result.events[0].t - first) < 2e-8);
}

TEST_CASE("the uncertainty of an event is its error over its rate, for both engines") {
  // free fall onto a stop: g' = -sqrt(2 g h)
  for (const char* engine : {"ida", "exact"}) {
    CAPTURE(engine);
    const Result result = run_text(
        matrix_scene("t_end = 1.0\ninitial = { u = [0.5], v = [0.0] }", "mass = [[1.0]]\nstiffness = [[0.0]]",
                     "law = \"compliant\"\nnormal = { d0 = 1.0 }\nnormal_stiffness = 1e4",
                     "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = -9.81\n"),
        engine);
    REQUIRE(result.events.size() >= 2);
    const Event& e = result.events[0];
    CHECK(*e.guard_rate == doctest::Approx(-std::sqrt(2.0 * 9.81 * 0.5)));
    CHECK(*e.t_uncertainty > 0.0);
    CHECK(*e.t_uncertainty < (std::string(engine) == "ida" ? 1e-9 : 1e-12));
  }
}

TEST_CASE("two events closer than their uncertainty: their order is said to be open") {
  const auto run = [](double shift) {
    return run_text(
        matrix_scene(
            fmt::format("t_end = 1.0\ninitial = {{ u = [0.5, {:.17g}], v = [0.0, 0.0] }}", 0.5 + shift),
            "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[0.0, 0.0], [0.0, 0.0]]",
            "law = \"compliant\"\nnormal = { d0 = 1.0 }\nnormal_stiffness = 1e4",
            "[[contacts]]\nname = \"other\"\nlaw = \"compliant\"\nnormal = { d1 = 1.0 }\n"
            "normal_stiffness = 1e4\n"
            "[[loads]]\ndirection = { d0 = 1.0, d1 = 1.0 }\namplitude = -9.81\n"),
        "ida", "1e-6");
  };
  CHECK(!run(1e-8).report.warnings.empty());
  CHECK(run(1e-8).report.warnings[0].find("order") != std::string::npos);
  CHECK(run(1e-2).report.warnings.empty());
}

TEST_CASE("double zero eigenvalues, a defective slip mode and an undamped free flight keep their digits") {
  // two free masses, one friction contact between a moving belt and the first: u = u0 + v0 t + a t^2/2
  const Result result =
      run_text(matrix_scene("t_end = 4.0\noutput_dt = 0.5\ninitial = { u = [0.0, 0.0], v = [3.0, 1.0] }",
                            "mass = [[2.0, 0.0], [0.0, 1.0]]\nstiffness = [[0.0, 0.0], [0.0, 0.0]]",
                            "law = \"slider\"\ntangent = { d0 = 1.0 }\nfriction = 0.25\nnormal_force = 2.0"),
               "exact");
  for (const Result::Row& row : result.rows) {
    CHECK(row.u[0] == doctest::Approx(3.0 * row.t - 0.125 * row.t * row.t).epsilon(1e-15));
    CHECK(row.u[1] == doctest::Approx(1.0 * row.t).epsilon(1e-15));
  }
}

TEST_CASE("a stuck block feels only its load: slip where P(t), normal_force(t) or the surface says so") {
  const std::string run = "t_end = 3.4\ninitial = { u = [0.0], v = [0.0] }";
  const std::string held =
      "law = \"slider\"\ntangent = { d0 = 1.0 }\nfriction = 1.0\nnormal_force = 10.0\n"
      "[[contacts]]\nname = \"s\"\nlaw = \"slider\"\ntangent = { d0 = 1.0 }\nfriction = 1.0\n"
      "tangential_stiffness = 1.0\n";
  const double pi = std::numbers::pi;
  SUBCASE("load: (1 - cos t)/2 = 0.99998") {
    const Result r = run_text(
        matrix_scene(run, "mass = [[1.0]]\nstiffness = [[0.0]]",
                     "law = \"slider\"\ntangent = { d0 = 1.0 }\nfriction = 0.99998\nnormal_force = 1.0",
                     "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 0.5\n"
                     "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 0.5\nhistory = { type = \"harmonic\", "
                     "omega = 1.0, phase = -1.5707963267948966 }\n"),
        "exact");
    REQUIRE(r.events.size() == 2);
    CHECK(std::abs(r.events[0].t - (pi - 2.0 * std::asin(std::sqrt(2e-5)))) < 1e-11);
  }
  SUBCASE("compression: 2 + cos t = 1.00005") {
    const Result r =
        run_text(matrix_scene(run, "mass = [[1.0]]\nstiffness = [[1.0]]",
                              held + "initial_shear = 1.00005\nnormal_force = { type = \"harmonic\", "
                                     "omega = 1.0, phase = 1.5707963267948966, offset = 2.0 }"),
                 "exact");
    REQUIRE(r.events.size() == 2);
    CHECK(std::abs(r.events[0].t - (pi - 2.0 * std::asin(std::sqrt(2.5e-5)))) < 1e-11);
    CHECK(std::abs(r.events[1].t - pi) < 1e-7);  // the slip rate is N'(t): a grazing return
  }
  SUBCASE("surface: 1 - cos t = 1.9999") {
    const Result r = run_text(matrix_scene(run, "mass = [[1.0]]\nstiffness = [[1.0]]",
                                           held + "normal_force = 1.9999\nsurface_velocity = { type = "
                                                  "\"harmonic\", omega = 1.0 }"),
                              "exact");
    REQUIRE(r.events.size() == 2);
    CHECK(std::abs(r.events[0].t - (pi - 2.0 * std::asin(std::sqrt(5e-5)))) < 1e-11);
  }
}

TEST_CASE("a load that grows with t^13 from rest, and motions of very different size") {
  const Result r =
      run_text(matrix_scene("t_end = 2.0\ninitial = { u = [0.0, 0.001], v = [0.0, 0.0] }",
                            "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[0.0, 0.0], [0.0, 4.0]]",
                            "law = \"slider\"\ntangent = { d1 = 1.0 }\nfriction = 0.0\n"
                            "normal_force = 1.0",
                            "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 1e9\nhistory = { type = "
                            "\"polynomial\", coefficients = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, "
                            "0.0, 0.0, 0.0, 0.0, 0.0, 1.0] }\n"),
               "exact");
  const Result::Row& end = r.rows.back();
  CHECK(end.u[0] == doctest::Approx(1e9 * std::pow(2.0, 15) / 210.0).epsilon(1e-14));
  CHECK(end.u[1] == doctest::Approx(0.001 * std::cos(4.0)).epsilon(1e-11));
}

TEST_CASE("a polynomial beyond the series is refused, not cut") {
  std::string coefficients = "0.0";
  for (int i = 0; i < 29; ++i) coefficients += ", 1.0";
  CHECK_THROWS_WITH_AS(
      (void)run_text(matrix_scene("t_end = 1.0\ninitial = { u = [0.0], v = [0.0] }",
                                  "mass = [[1.0]]\nstiffness = [[1.0]]",
                                  "law = \"slider\"\ntangent = { d0 = 1.0 }\nfriction = 0.1\n"
                                  "normal_force = 1.0",
                                  "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 1.0\nhistory "
                                  "= { type = \"polynomial\", coefficients = [" +
                                      coefficients + "] }\n"),
                     "exact"),
      doctest::Contains("polynomials up to degree 28"), SceneError);
}

TEST_CASE("a contact far below the resolution of the clock stops the run instead of being lost") {
  const Result r =
      run_text(matrix_scene("t_end = 1000000.00001\noutput_times = [1.0]\ninitial = { u = [0.0], v = "
                            "[1.0] }",
                            "mass = [[1.0]]\nstiffness = [[0.0]]",
                            "law = \"compliant\"\nnormal = { d0 = -1.0 }\ngap = 1000000.0\n"
                            "normal_stiffness = 1e18"),
               "exact");
  CHECK(r.report.outcome.kind == Outcome::Kind::stopped);
  CHECK(r.report.outcome.reason.find("resolution of time") != std::string::npos);
}

TEST_CASE("a stiff pair that its own symmetry hides keeps its digits") {
  const Result r = run_text(
      matrix_scene(
          "t_end = 100.0\noutput_dt = 10.0\ninitial = { u = [1.0, 1.0, 1.0, 1.0], v = [0.0, 0.0, 0.0, 0.0] }",
          "mass = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, "
          "1.0]]\nstiffness = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1000001.0, "
          "-1000000.0], [0.0, 0.0, -1000000.0, 1000001.0]]",
          "law = \"slider\"\ntangent = { d0 = 1.0 }\nfriction = 0.0\nnormal_force = 1.0"),
      "exact");
  for (const Result::Row& row : r.rows)
    for (int i = 0; i < 4; ++i) CHECK(row.u[i] == doctest::Approx(std::cos(row.t)).epsilon(1e-9));
  CHECK(r.report.counters.steps > 5000);  // the pair's 1.4e3 rad/s rule the step
}

TEST_CASE("many grazes: a handful of warnings, not one each") {
  const Result r =
      run_text(matrix_scene("t_end = 100.0\noutput_dt = 50.0\ninitial = { u = [1.0], v = [0.0] }",
                            "mass = [[1.0]]\nstiffness = [[1.0]]",
                            "law = \"compliant\"\nnormal = { d0 = 1.0 }\nnormal_stiffness = 1e-9\n"
                            "gap = 1.0"),
               "exact");
  CHECK(r.report.warnings.size() <= 6);
}

TEST_CASE("a light part on a stiff contact: the rounding of kn g decides what is zero, and the run goes on") {
  // Found among random scenes: kn g = 1e4 - 1e4 makes the slip rate uncertain by more than its own terms.
  const Result r = run_text(R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 3.0
initial = { u=[0.0, 0.1627, 0.9063, -0.9993], v=[0.0, -0.6892, -0.3243, -0.3886] }
output_dt = 0.15
[matrices]
mass=[[0.0, 0.0, 0.0, 0.0], [0.0, 2.543, 0.0, 0.0], [0.0, 0.0, 0.437, 0.0], [0.0, 0.0, 0.0, 0.957]]
stiffness=[[5.121, -0.726, 0.0, 0.0], [-0.726, 43.479, -27.143, 0.0], [0.0, -27.143, 101.626, -64.874], [0.0, 0.0, -64.874, 67.656]]
damping=[[0.694, -0.128, 0.0, 0.0], [-0.128, 1.138, -0.601, 0.0], [0.0, -0.601, 2.109, -0.788], [0.0, 0.0, -0.788, 0.903]]
[[contacts]]
name="c0"
law="compliant"
normal={ d0=1.0 }
tangent={ d3=1.0 }
gap=0.2567
normal_stiffness=4876334.7685
tangential_stiffness=1901.8875
friction=1.7378
[[contacts]]
name="c1"
law="slider"
tangent={ d0=0.5 }
friction={ static=0.6093, kinetic=0.4547 }
normal_force={ type="harmonic", omega=3.035, phase=2.977, start=0.0, amplitude=1.6527, offset=2.0369 }
tangential_stiffness=17.7224
initial_shear=0.1872
[[contacts]]
name="c2"
law="compliant"
normal={ d0=1.0 }
tangent={ d3=1.0 }
gap=-0.1791
normal_stiffness=56623.2946
tangential_stiffness=56056.3607
friction=1.4943
)",
                            "exact");
  INFO(r.report.outcome.reason);
  CHECK(r.report.outcome.kind == Outcome::Kind::done);
  CHECK(r.report.audit.energy.value < 1e-11 * r.report.audit.energy_scale);
}

TEST_SUITE_END();
