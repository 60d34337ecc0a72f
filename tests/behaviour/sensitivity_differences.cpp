// Derivatives of runs against differences of `exact`, where there is no closed form.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "behaviour/one_mass.hpp"
#include "behaviour/rates.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

/// Every derivative of every event against differences of fourth order; in parts of the greatest of its
/// column.
void check_differences(const SceneReader& read, const std::string& path, double part,
                       double relative = 2e-4) {
  CAPTURE(path);
  const Sensitivities s = sensitivities(read, {path});
  const double p = s.parameters[0].value;
  const double h = relative * (p != 0.0 ? std::abs(p) : 1.0);
  CAPTURE(s.parameters[0].reason);
  std::vector<Result> runs;
  for (const int k : {-2, -1, 1, 2})
    runs.push_back(run_exact(read, {path, fmt::format("{:.17g}", p + k * h)}));
  for (const Result& run : runs) REQUIRE(run.events.size() == s.events.size());
  const auto difference = [&](auto value) {
    return (8.0 * (value(runs[2]) - value(runs[1])) - (value(runs[3]) - value(runs[0]))) / (12.0 * h);
  };
  double greatest = 0.0;
  for (const auto& row : s.event_rates) greatest = std::max(greatest, std::abs(row[0].t));
  for (std::size_t i = 0; i < s.events.size(); ++i) {
    CAPTURE(i);
    const EventRates& rates = s.event_rates[i][0];
    CHECK(std::abs(rates.t - difference([&](const Result& r) { return r.events[i].t; })) <= part * greatest);
    if (s.events[i].contact < 0) continue;
    for (const auto& [mine, theirs] :
         {std::pair{&EventRates::N, &Event::N}, std::pair{&EventRates::T, &Event::T},
          std::pair{&EventRates::N_after, &Event::N_after}, std::pair{&EventRates::T_after, &Event::T_after},
          std::pair{&EventRates::vn, &Event::vn}, std::pair{&EventRates::vt, &Event::vt},
          std::pair{&EventRates::vn_after, &Event::vn_after},
          std::pair{&EventRates::vt_after, &Event::vt_after}}) {
      double size = 0.0;
      for (const auto& row : s.event_rates)
        if (std::isfinite(row[0].*mine)) size = std::max(size, std::abs(row[0].*mine));
      const double expected = difference([&](const Result& r) { return r.events[i].*theirs; });
      CHECK(std::abs(rates.*mine - expected) <= part * std::max(size, 1e-3));
    }
  }
  REQUIRE(s.times.size() == runs[0].rows.size());
  for (std::size_t i = 0; i < s.times.size(); ++i) {
    const double expected = difference([&](const Result& r) { return r.rows[i].contacts[0].ut; });
    const auto column =
        std::find(s.columns.begin(), s.columns.end(), s.contacts[0] + ".ut") - s.columns.begin();
    const double found = s.value_rates[0][i][static_cast<std::size_t>(column)];
    CHECK(std::abs(found - expected) <= 10.0 * part * std::max(std::abs(expected), 1e-3));
  }
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/sensitivity_differences");

TEST_CASE("friction that depends on the slip rate, by its constants and by the belt, against differences") {
  const SceneReader belt = reader_of_text(matrix_scene(
      "t_end = 20.0\noutput_dt = 5.0\nengine = \"ida\"\nrtol = 1e-10\ninitial = { u = [0.0], v = [0.0] }",
      "mass = [[1.0]]\nstiffness = [[1.0]]",
      "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nsurface_velocity = 0.3\n"
      "friction = { static = 0.6, kinetic = 0.4, stribeck_velocity = 0.5 }"));
  for (const char* path :
       {"contacts.c.friction.static", "contacts.c.friction.kinetic", "contacts.c.friction.stribeck_velocity",
        "contacts.c.surface_velocity", "contacts.c.normal_force"}) {
    CAPTURE(path);
    const Sensitivities s = sensitivities(belt, {path});
    CAPTURE(s.parameters[0].reason);
    const double p = s.parameters[0].value, h = 1e-3 * p;
    std::vector<Result> runs;
    for (const int k : {-2, -1, 1, 2}) {
      const Scene scene = belt({{path, fmt::format("{:.17g}", p + k * h)}});
      runs.push_back(simulate(build_model(scene), scene.run));
      REQUIRE(runs.back().events.size() == s.events.size());
    }
    REQUIRE(s.events.size() > 4);
    for (std::size_t i = 0; i < s.events.size(); ++i) {
      CAPTURE(i);
      const auto t = [&](std::size_t run) { return runs[run].events[i].t; };
      const double expected = (8.0 * (t(2) - t(1)) - (t(3) - t(0))) / (12.0 * h);
      CHECK(std::abs(s.event_rates[i][0].t - expected) <= 1e-6 * std::max(1.0, std::abs(expected)));
    }
  }
}

TEST_CASE("data of the pipeline that move its matrices and its static start, against differences") {
  const std::vector<Override> shorter{
      {"run.engine", "exact"}, {"run.t_end", "0.01"}, {"run.output_dt", "0.01"}};
  const SceneReader read = reader_of(std::string(SIGNORINI_MODELS) + "/pipeline.toml", shorter);
  check_differences(read, "sections.pipe.EI", 1e-7, 1e-5);
  check_differences(read, "contacts.first.normal_stiffness", 1e-7, 1e-5);
  check_differences(read, "nodes.D.1", 1e-5, 1e-5);
  check_differences(read, "nodes.D.2", 1e-5,
                    1e-5);  // forms have entries beside its value that they lack at it
  check_differences(read, "gravity.2", 1e-7, 1e-4);
  check_differences(read, "damping.alpha_over_omega1", 1e-6, 1e-3);
}

TEST_CASE(
    "impacts with friction, elements with dashpots, shear elements and jumps of friction, against "
    "differences") {
  const std::string foot = "law = \"rigid\"\nrestitution = 0.4\nfriction = 0.3\ncapture_velocity = 0.01\n";
  const std::string plane =
      "mass = [[2.0, 0.0, 0.0], [0.0, 0.7, 0.0], [0.0, 0.0, 2.0]]\nstiffness = [[0.0, 0.0, 0.0], "
      "[0.0, 0.0, 0.0], [0.0, 0.0, 3.0]]";
  // a tilted bar falls on its feet while it moves sideways
  const SceneReader bar = reader_of_text(matrix_scene(
      "t_end = 0.4\noutput_dt = 0.2\ninitial = { u = [0.4, 0.11, 0.0], v = [0.0, 0.0, 0.5] }", plane,
      foot +
          "normal = { d0 = 1.0, d1 = 1.0 }\ntangent = { d2 = 1.0, d1 = 0.2 }\n[[contacts]]\nname = \"b\"\n" +
          foot + "normal = { d0 = 1.0, d1 = -1.0 }\ntangent = { d2 = 1.0, d1 = 0.2 }",
      "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = -20.0\n"));
  for (const char* path : {"contacts.*.friction", "contacts.c.restitution", "loads.1.amplitude",
                           "run.initial.v.3", "contacts.b.gap"})
    check_differences(bar, path, 1e-8);
  // a block that is shaken on an element with dashpots
  const auto element = [](const std::string& more) {
    return reader_of_text(matrix_scene(
        "t_end = 1.2\noutput_dt = 0.4\ninitial = { u = [0.0, 0.002], v = [0.0, 0.0] }",
        "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[40.0, 0.0], [0.0, 0.0]]",
        "law = \"compliant\"\nnormal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\nnormal_stiffness = 4000.0\n"
        "tangential_stiffness = 3000.0\n" +
            more,
        "[[loads]]\ndirection = { d1 = 1.0 }\namplitude = -10.0\n[[loads]]\ndirection = { d0 = 1.0 "
        "}\namplitude = 6.0\n"
        "history = { type = \"harmonic\", omega = 7.0 }\n"));
  };
  for (const char* path : {"contacts.c.friction.static", "contacts.c.friction.kinetic",
                           "contacts.c.tangential_stiffness", "loads.2.history.omega"})
    check_differences(element("friction = { static = 0.4, kinetic = 0.3 }"), path, 1e-8);
  for (const char* path : {"contacts.c.normal_damping", "contacts.c.friction", "contacts.c.normal_stiffness"})
    check_differences(element("friction = 0.3\nnormal_damping = 12.0"), path, 1e-8);
  for (const char* path : {"contacts.c.tangential_damping", "contacts.c.friction"})
    check_differences(element("friction = 0.3\ntangential_damping = 5.0"), path, 1e-8);
}

TEST_CASE("a mass on a belt: speed of the surface, static friction above kinetic") {
  const SceneReader belt = reader_of_text(
      matrix_scene("t_end = 20.0\noutput_dt = 5.0\ninitial = { u = [0.0], v = [0.0] }",
                   "mass = [[1.0]]\nstiffness = [[1.0]]",
                   "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nsurface_velocity = 0.3\n"
                   "friction = { static = 0.6, kinetic = 0.4 }"));
  for (const char* path : {"contacts.c.surface_velocity", "contacts.c.friction.static",
                           "contacts.c.friction.kinetic", "contacts.c.normal_force"})
    check_differences(belt, path, 1e-8);
}
