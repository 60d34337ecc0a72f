// Events that sign changes at the ends of steps do not show: each is found, and counted exactly once.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "behaviour/engines.hpp"
#include "behaviour/one_mass.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

constexpr double half_turn = std::numbers::pi / 2.0;  // of the free mass, omega = 2

}  // namespace

TEST_SUITE_BEGIN("behaviour/nothing missed");

TEST_CASE("short contacts: an oscillator that touches a stop by a depth of 1e-2 to 1e-8 of its amplitude") {
  // u = cos t, stop at g = 1 - d + u: touches at acos(-(1 - d)) with g' = -sqrt(2 d - d^2)
  for (const std::string& engine : engines)
    for (double d : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
      CAPTURE(d);
      const Result result = run_text(
          matrix_scene(
              "t_end = 6.0\noutput_times = [6.0]\ninitial = { u = [1.0], v = [0.0] }",
              "mass = [[1.0]]\nstiffness = [[1.0]]",
              fmt::format("law = \"compliant\"\nnormal = {{ d0 = 1.0 }}\ngap = {}\nnormal_stiffness = 50.0",
                          1.0 - d)),
          engine);
      REQUIRE(result.events.size() == 2);
      CHECK(result.events[0].type == EventType::contact);
      CHECK(result.events[1].type == EventType::separation);
      const double rate = std::sqrt(2.0 * d - d * d), tolerance = 2e-10;
      CHECK(std::abs(result.events[0].t - std::acos(-(1.0 - d))) * rate < 20.0 * tolerance);
    }
}

TEST_CASE("short stick phases: v = ((t - 1)^2 - e^2)/2 dips below zero for 2 e, and the block sticks for e") {
  // m = 1, N = 1, f = 1, P = t: slip until 1 - e, stick until P = f at t = 1
  for (const std::string& engine : locating_engines)
    for (double e : {1e-1, 1e-2, 1e-3, 1e-4}) {
      CAPTURE(e);
      const Result result = run_text(
          matrix_scene(fmt::format("t_end = 2.0\noutput_times = [2.0]\ninitial = {{ u = [0.0], v = [{}] }}",
                                   0.5 * (1.0 - e * e)),
                       "mass = [[1.0]]\nstiffness = [[0.0]]",
                       "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = 1.0",
                       "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 1.0\nhistory = { type = "
                       "\"polynomial\", coefficients = [0.0, 1.0] }\n"),
          engine);
      REQUIRE(result.events.size() == 2);
      CHECK(result.events[0].to == State::stick);
      CHECK(std::abs(result.events[0].t - (1.0 - e)) * e < 20.0 * 2e-10);
      CHECK(result.events[1].to == State::slip_plus);
      CHECK(result.events[1].t == doctest::Approx(1.0).epsilon(1e-9));
    }
}

TEST_CASE("two crossings inside one step are found by the polynomial check, not by a sign change") {
  // u'' = 1, u = 1.9999 - 2 t + t^2/2 = (t - 2)^2/2 - 1e-4: touches for 0.028 around t = 2, and the flight is
  // a polynomial, so that the integrator takes steps far longer than that
  const Result touching =
      run_text(matrix_scene("t_end = 4.0\noutput_times = [4.0]\ninitial = { u = [1.9999], v = [-2.0] }",
                            "mass = [[1.0]]\nstiffness = [[0.0]]",
                            "law = \"compliant\"\nnormal = { d0 = 1.0 }\ngap = 0.0\nnormal_stiffness = 1.0",
                            "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 1.0\n"),
               "ida", "1e-6");
  CHECK(touching.events.size() == 2);
  CHECK(touching.report.counters.rolled_back >= 1);
}

TEST_CASE("events on output times, once each") {
  const Result result = run_text(
      matrix_scene(
          fmt::format(
              "t_end = 10.0\noutput_times = [{}, {}, {}, 10.0]\ninitial = {{ u = [1.03], v = [0.0] }}",
              half_turn, 2.0 * half_turn, 3.0 * half_turn),
          "mass = [[1.0]]\nstiffness = [[4.0]]",
          "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = 0.4"),
      "ida");
  CHECK(result.events.size() == 5);
  REQUIRE(result.rows.size() == 4);
  CHECK(result.rows[0].t == half_turn);
  for (const Result::Row& row : result.rows) CHECK(std::abs(row.contacts[0].T) <= 0.4 * (1.0 + 1e-12));
}

TEST_CASE("events on kinks and jumps of the load, once each") {
  for (const std::string& engine : engines) {
    SUBCASE("the friction limit is reached at the very peak of a triangle: it only touches") {
      const Result result = run_text(
          matrix_scene("t_end = 2.0\ninitial = { u = [0.0], v = [0.0] }",
                       "mass = [[1.0]]\nstiffness = [[1.0]]",
                       "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = 0.5",
                       "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 0.5\nhistory = { type = "
                       "\"triangle\", end = 1.0 }\n"),
          engine);
      CHECK(result.events.empty());
      CHECK(result.rows.back().u[0] == 0.0);
    }
    SUBCASE("a step that exceeds the limit") {
      const Result result = run_text(
          matrix_scene("t_end = 2.0\ninitial = { u = [0.0], v = [0.0] }",
                       "mass = [[1.0]]\nstiffness = [[1.0]]",
                       "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = 0.5",
                       "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 0.8\nhistory = { type = \"step\", "
                       "start = 1.0 }\n"),
          engine);
      REQUIRE(result.events.size() == 2);
      CHECK(result.events[0].type == EventType::time);
      CHECK(result.events[1].type == EventType::slip);
      CHECK(result.events[1].t == 1.0);
      CHECK(result.events[1].T == 0.0);
      CHECK(result.events[1].T_after == doctest::Approx(0.5));
    }
    SUBCASE("a step below the limit changes T without changing the state: a time row of the contact") {
      const Result result = run_text(
          matrix_scene("t_end = 2.0\ninitial = { u = [0.0], v = [0.0] }",
                       "mass = [[1.0]]\nstiffness = [[1.0]]",
                       "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = 0.5",
                       "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 0.3\nhistory = { type = \"step\", "
                       "start = 1.0 }\n"),
          engine);
      REQUIRE(result.events.size() == 2);
      CHECK(result.events[1].type == EventType::time);
      CHECK(result.events[1].contact == 0);
      CHECK(result.events[1].T_after == doctest::Approx(0.3));
    }
  }
}

TEST_CASE("events in the first step") {
  for (const std::string& engine : engines)
    for (double gap : {1e-3, 1e-6, 1e-9, 1e-12}) {
      CAPTURE(gap);
      const Result result = run_text(
          matrix_scene(
              "t_end = 0.01\ninitial = { u = [0.0], v = [-1.0] }", "mass = [[1.0]]\nstiffness = [[0.0]]",
              fmt::format("law = \"compliant\"\nnormal = {{ d0 = 1.0 }}\ngap = {}\nnormal_stiffness = 1.0e4",
                          gap)),
          engine);
      REQUIRE(result.events.size() == 1);
      CHECK(result.events[0].t == doctest::Approx(gap).epsilon(1e-6));
    }
}

TEST_CASE("simultaneous events of identical contacts: every one, once") {
  for (const std::string& engine : engines) {
    std::string text =
        matrix_scene("t_end = 20.0\noutput_dt = 1.0\ninitial = { u = [0.0, 0.0, 0.0], v = [0.0, 0.0, 0.0] }",
                     "mass = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]\n"
                     "stiffness = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]",
                     "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = 0.8");
    for (int i : {1, 2})
      text += fmt::format(
          "[[contacts]]\nname = \"c{}\"\nlaw = \"slider\"\ntangent = {{ d{} = 1.0 }}\nnormal_force = "
          "1.0\nfriction = 0.8\n",
          i, i);
    for (int i : {0, 1, 2})
      text += fmt::format(
          "[[loads]]\ndirection = {{ d{} = 1.0 }}\namplitude = 1.0\nhistory = {{ type = \"harmonic\", omega "
          "= 0.5 }}\n",
          i);
    const Result result = run_text(text, engine);
    REQUIRE(result.events.size() % 3 == 0);
    REQUIRE(result.events.size() >= 9);
    for (std::size_t i = 0; i < result.events.size(); i += 3) {
      CHECK(result.events[i + 2].t - result.events[i].t < 1e-9);
      CHECK(result.events[i].to == result.events[i + 2].to);
      CHECK(result.events[i].contact + result.events[i + 1].contact + result.events[i + 2].contact == 3);
    }
  }
}

TEST_SUITE_END();
