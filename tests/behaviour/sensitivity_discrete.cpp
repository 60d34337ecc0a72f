// Derivatives of what `newmark` computes against differences of its own runs, and against those of the motion.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "behaviour/one_mass.hpp"
#include "signorini/error.hpp"
#include "signorini/sensitivity.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

SceneReader stepped(const std::string& text, const std::string& dt) {
  return [text, dt](const std::vector<Override>& changes) {
    std::vector<Override> all{{"run.engine", "newmark"}, {"run.dt", dt}};
    all.insert(all.end(), changes.begin(), changes.end());
    return parse_scene(text, "test.toml", all);
  };
}

/// All of events and columns within `part` of differences of the same steps; h: relative.
void check_steps(const SceneReader& read, const std::string& path, double part, double h = 1e-4) {
  CAPTURE(path);
  const Sensitivities s = sensitivities(read, {path}, nullptr, {false, true});
  REQUIRE(s.parameters[0].reason.empty());
  REQUIRE(s.events.size() > 1);
  const double p = s.parameters[0].value, step = h * (p != 0.0 ? std::abs(p) : 1.0);
  std::vector<Sensitivities> runs;
  for (const int k : {-2, -1, 1, 2}) {
    const SceneReader moved = [&](const std::vector<Override>& changes) {
      std::vector<Override> all{{path, fmt::format("{:.17g}", p + k * step)}};
      all.insert(all.end(), changes.begin(), changes.end());
      return read(all);
    };
    runs.push_back(sensitivities(moved, {}, nullptr, {false, true}));
    REQUIRE(runs.back().events.size() == s.events.size());
  }
  const auto difference = [&](const auto& value) {
    return (8.0 * (value(runs[2]) - value(runs[1])) - (value(runs[3]) - value(runs[0]))) / (12.0 * step);
  };
  for (const auto& [mine, theirs] :
       {std::pair{&EventRates::t, &Event::t}, std::pair{&EventRates::N, &Event::N},
        std::pair{&EventRates::T, &Event::T}, std::pair{&EventRates::N_after, &Event::N_after},
        std::pair{&EventRates::T_after, &Event::T_after}, std::pair{&EventRates::vn, &Event::vn},
        std::pair{&EventRates::vt, &Event::vt}, std::pair{&EventRates::vn_after, &Event::vn_after},
        std::pair{&EventRates::vt_after, &Event::vt_after}}) {
    double size = 0.0;
    std::vector<double> expected;
    for (std::size_t i = 0; i < s.events.size(); ++i) {
      expected.push_back(difference([&](const Sensitivities& r) { return r.events[i].*theirs; }));
      size = std::max(size, std::abs(expected.back()));
    }
    for (std::size_t i = 0; i < s.events.size(); ++i) {
      CAPTURE(i);
      CAPTURE(expected[i]);
      if (s.events[i].contact >= 0 || mine == &EventRates::t)
        CHECK(std::abs(s.event_rates[i][0].*mine - expected[i]) <= part * std::max(size, 1e-3));
    }
  }
  for (std::size_t column = 0; column < s.columns.size(); ++column) {
    double size = 0.0;
    std::vector<double> expected;
    for (std::size_t i = 0; i < s.times.size(); ++i) {
      expected.push_back(difference([&](const Sensitivities& r) { return r.values[i][column]; }));
      size = std::max(size, std::abs(expected.back()));
    }
    CAPTURE(s.columns[column]);
    for (std::size_t i = 0; i < s.times.size(); ++i)
      CHECK(std::abs(s.value_rates[0][i][column] - expected[i]) <= part * std::max(size, 1e-3));
  }
}

std::string stepped_block(const std::string& contact, const std::string& load = "harmonic\", omega = 7.0") {
  return matrix_scene("t_end = 1.2\noutput_dt = 0.17\ninitial = { u = [0.0, 0.002], v = [0.0, 0.0] }",
                      "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[40.0, 0.0], [0.0, 0.0]]\n"
                      "damping = [[1.5, 0.2], [0.2, 0.8]]",
                      "law = \"compliant\"\nnormal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\n"
                      "normal_stiffness = 400.0\ntangential_stiffness = 300.0\n" +
                          contact,
                      "[[loads]]\ndirection = { d1 = 1.0 }\namplitude = -10.0\n[[loads]]\ndirection = { d0 = "
                      "1.0 }\namplitude = 12.0\nhistory = { type = \"" +
                          load + " }\n");
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/sensitivity_discrete");

TEST_CASE("steps of newmark: derivatives of the discrete algorithm against differences of itself") {
  for (const char* path :
       {"contacts.c.friction", "contacts.c.normal_stiffness", "contacts.c.tangential_stiffness",
        "loads.2.amplitude", "loads.2.history.omega", "matrices.mass.1.1", "matrices.damping.1.1",
        "matrices.stiffness.1.1", "run.initial.u.2"})
    check_steps(stepped(stepped_block("friction = 0.3"), "0.013"), path, 1e-7);
  check_steps(stepped(stepped_block("friction = { static = 0.4, kinetic = 0.3 }"), "0.013"),
              "contacts.c.friction.kinetic", 1e-7);
  check_steps(stepped(stepped_block("friction = 0.3\nnormal_damping = 3.0"), "0.013"),
              "contacts.c.normal_damping", 1e-7);
  for (const char* path : {"loads.2.history.end", "contacts.c.friction"})  // a load whose instant moves
    check_steps(stepped(stepped_block("friction = 0.3", "rectangle\", start = 0.1, end = 0.5"), "0.013"),
                path, 1e-7);
}

TEST_CASE("steps of newmark under a slider that is pressed more and less") {
  const SceneReader pressed = stepped(
      matrix_scene("t_end = 12.0\noutput_dt = 1.3\ninitial = { u = [1.0], v = [0.0] }",
                   "mass = [[1.0]]\nstiffness = [[4.0]]",
                   "law = \"slider\"\ntangent = { d0 = 1.0 }\nfriction = { static = 0.5, kinetic = 0.4 }\n"
                   "tangential_stiffness = 30.0\n"
                   "normal_force = { type = \"harmonic\", amplitude = 0.3, omega = 3.0, offset = 1.0 }"),
      "0.03");
  for (const char* path : {"contacts.c.friction.kinetic", "contacts.c.normal_force.omega",
                           "contacts.c.normal_force.amplitude", "matrices.stiffness.1.1"})
    check_steps(pressed, path, 1e-7);
}

TEST_CASE("steps of newmark on a belt and through impacts") {
  const SceneReader belt = stepped(
      matrix_scene("t_end = 20.0\noutput_dt = 3.1\ninitial = { u = [0.0], v = [0.0] }",
                   "mass = [[1.0]]\nstiffness = [[1.0]]",
                   "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nsurface_velocity = 0.3\n"
                   "friction = { static = 0.6, kinetic = 0.4 }"),
      "0.07");
  for (const char* path : {"contacts.c.surface_velocity", "contacts.c.friction.static"})
    check_steps(belt, path, 1e-7);
  const SceneReader ball =
      stepped(matrix_scene("t_end = 1.2\noutput_dt = 0.5\ninitial = { u = [1.0], v = [0.0] }",
                           "mass = [[1.0]]\nstiffness = [[3.0]]",
                           "law = \"rigid\"\nnormal = { d0 = 1.0 }\nrestitution = 0.5",
                           "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = -10.0\n"),
              "0.03");
  for (const char* path : {"contacts.c.restitution", "matrices.stiffness.1.1", "run.initial.u.1"})
    check_steps(ball, path, 1e-7);
}

TEST_CASE("derivatives of steps go to those of the motion by the square of the step") {
  const auto apart = [](const char* dt) {
    const SceneReader read = stepped(stepped_block("friction = 0.3"), dt);
    const Sensitivities steps = sensitivities(read, {"contacts.c.friction"}, nullptr, {false, true});
    const Sensitivities motion = sensitivities(
        [&](std::vector<Override> changes) {
          changes.insert(changes.begin(), {"run.engine", "exact"});
          return parse_scene(stepped_block("friction = 0.3"), "test.toml", changes);
        },
        {"contacts.c.friction"});
    REQUIRE(steps.events.size() == motion.events.size());
    double most = 0.0;
    for (std::size_t i = 0; i < steps.events.size(); ++i)
      most = std::max(most, std::abs(steps.event_rates[i][0].t - motion.event_rates[i][0].t));
    return most;
  };
  const double coarse = apart("2e-3"), fine = apart("1e-3");
  CHECK(coarse / fine > 3.0);
  CHECK(coarse / fine < 5.0);
}

TEST_CASE("discrete derivatives are newmark's, of steps of one length") {
  const std::string text = stepped_block("friction = 0.3");
  const auto by = [&](const std::vector<Override>& more, SensitivityOptions options) {
    return sensitivities(
        [&](std::vector<Override> changes) {
          changes.insert(changes.begin(), more.begin(), more.end());
          return parse_scene(text, "test.toml", changes);
        },
        {"contacts.c.friction"}, nullptr, options);
  };
  CHECK_THROWS_AS((void)by({{"run.engine", "exact"}}, {false, true}), UsageError);
  CHECK_THROWS_AS((void)by({{"run.engine", "newmark"}, {"run.dt", "0.01"}}, {true, true}), UsageError);
  const Sensitivities linear =
      by({{"run.engine", "newmark"}, {"run.dt", "0.01"}, {"run.refine", "linear"}}, {false, true});
  CHECK(linear.parameters[0].until == 0.0);
  CHECK(linear.parameters[0].reason.find("interpolated") != std::string::npos);
}

TEST_SUITE_END();
