// Physical systems with closed-form answers, each through every engine.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "behaviour/engines.hpp"
#include "behaviour/one_mass.hpp"
#include "result/run_tables.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

constexpr double pi = std::numbers::pi;

}  // namespace

TEST_SUITE_BEGIN("behaviour/friction");

TEST_CASE("Coulomb pad (Code_Aster SDND100): turning points every pi/100 s, then stuck") {
  // k = 1e4 N/m, m = 1 kg, N = 10 N, f = 0.1, released at 0.85 mm: -0.65, 0.45, -0.25, 0.05 mm
  const std::string text =
      matrix_scene("t_end = 0.2\noutput_times = [0.0, 0.2]\ninitial = { u = [0.85e-3], v = [0.0] }",
                   "mass = [[1.0]]\nstiffness = [[1.0e4]]",
                   "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 10.0\nfriction = 0.1");
  for (const std::string& engine : engines) {
    const Result result = run_text(text, engine);
    REQUIRE(result.events.size() == 4);
    for (std::size_t i = 0; i < 4; ++i)
      CHECK(std::abs(result.events[i].t - static_cast<double>(i + 1) * pi / 100.0) < 1e-10);
    CHECK(result.events.back().to == State::stick);
    CHECK(result.rows.back().u[0] == doctest::Approx(0.05e-3).epsilon(1e-6));
    CHECK(result.rows.back().v[0] == 0.0);
  }
}

TEST_CASE("a stuck slider without stiffness drifts by exactly zero under a varying load") {
  const std::string text = matrix_scene(
      "t_end = 50.0\noutput_dt = 1.0\ninitial = { u = [0.3, 0.1], v = [0.0, 0.4] }",
      "mass = [[1.0, 0.2], [0.2, 2.0]]\ndamping = [[0.1, 0.0], [0.0, 0.1]]\nstiffness = [[3.0, "
      "-1.0], [-1.0, 2.0]]",
      "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 10.0\nfriction = 0.9",
      "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 4.0\nhistory = { type = \"harmonic\", omega "
      "= 1.3 }\n");
  for (const std::string& engine : locating_engines) {
    const Result result = run_text(text, engine, "1e-6");
    CHECK(result.events.empty());
    for (const Result::Row& row : result.rows) {
      CHECK(row.u[0] == 0.3);
      CHECK(row.v[0] == 0.0);
    }
  }
}

TEST_CASE("stick-slip on a belt: the period of the limit cycle in closed form") {
  // m = k = 1: stick for 2 (fs - fk)/v, slip for 2 (pi - atan((fs - fk)/v))
  for (const std::string& engine : engines) {
    const Scene scene =
        read_scene(SIGNORINI_MODELS "/belt.toml", {{"run.rtol", "1e-10"}, {"run.engine", engine}});
    const Result result = simulate(build_model(scene), scene.run);
    const double v = 0.2, drop = 0.5;
    const double period = 2.0 * drop / v + 2.0 * (pi - std::atan(drop / v));
    std::vector<double> slips;
    for (const Event& e : result.events)
      if (e.type == EventType::slip) slips.push_back(e.t);
    REQUIRE(slips.size() > 5);
    for (std::size_t i = 2; i < slips.size(); ++i)
      CHECK(slips[i] - slips[i - 1] == doctest::Approx(period).epsilon(1e-8));
  }
}

TEST_CASE(
    "ratio of contacts.csv: T / N of the load while the block is held, the coefficient while it slips") {
  for (const double push : {2.0, -2.0, 6.0, -6.0}) {
    CAPTURE(push);
    const Scene scene = parse_scene(
        matrix_scene("t_end = 1.0\noutput_times = [1.0]\ninitial = { u = [0.0], v = [0.0] }",
                     "mass = [[1.0]]\nstiffness = [[0.0]]",
                     "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 10.0\nfriction = 0.35",
                     fmt::format("[[loads]]\ndirection = {{ d0 = 1.0 }}\namplitude = {}\n", push)),
        "test.toml");
    const Model model = build_model(scene);
    const Result result = simulate(model, scene.run);
    const result::ContactRow row{1.0, model.contacts[0], result.rows.back().contacts[0]};
    const std::string text = result::contact_table().text(std::vector<result::ContactRow>{row});
    CHECK(std::stod(text.substr(text.rfind(',') + 1)) ==
          doctest::Approx(std::abs(push) < 3.5 ? 0.2 : 0.35).epsilon(1e-12));
  }
}

TEST_CASE("vertical lift-off is one separation, although the friction limit vanishes with N") {
  const std::string text = matrix_scene(
      "t_end = 3.0\noutput_times = [3.0]\ninitial = { u = [0.0, -1.0e-5], v = [0.0, 0.0] }",
      "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[0.0, 0.0], [0.0, 0.0]]",
      "law = \"compliant\"\nnormal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\nnormal_stiffness = 1.0e6\n"
      "tangential_stiffness = 1.0e6\nfriction = 0.3",
      "[[loads]]\ndirection = { d1 = 1.0 }\namplitude = -10.0\n"
      "[[loads]]\ndirection = { d1 = 1.0 }\namplitude = 100.0\nhistory = { type = \"triangle\", end = 0.1 "
      "}\n");
  for (const std::string& engine : locating_engines) {
    const Result result = run_text(text, engine);
    REQUIRE(result.events.size() >= 2);
    CHECK(result.events[0].from == State::stick);
    CHECK(result.events[0].to == State::open);
    CHECK(result.events[0].type == EventType::separation);
    CHECK(result.events[1].type == EventType::contact);
    CHECK(result.events[1].to == State::stick);
    // What an event is by definition is no rounding of it: N vanishes where a contact opens, the gap where it closes.
    CHECK(result.events[0].N == 0.0);
    CHECK(result.events[0].T == 0.0);
    CHECK(result.events[0].gap == 0.0);
    CHECK(result.events[1].gap == 0.0);
  }
}

TEST_CASE("an undamped element gives back what it takes: bouncing conserves energy") {
  const std::string text =
      matrix_scene("t_end = 5.0\noutput_dt = 0.1\ninitial = { u = [0.5], v = [0.0] }",
                   "mass = [[1.0]]\nstiffness = [[0.0]]",
                   "law = \"compliant\"\nnormal = { d0 = 1.0 }\nnormal_stiffness = 1.0e4",
                   "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = -9.81\n");
  for (const std::string& engine : engines) {
    const Result result = run_text(text, engine);
    // flight sqrt(2 h/g) down; contact half a period about the static deflection and more
    const double w = 100.0, vn = std::sqrt(2.0 * 9.81 * 0.5), us = 9.81 / 1e4;
    const double contact = (pi + 2.0 * std::atan(us * w / vn)) / w, flight = 2.0 * vn / 9.81;
    double expected = vn / 9.81;
    for (std::size_t i = 0; i < result.events.size(); ++i) {
      CAPTURE(i);
      CHECK(std::abs(result.events[i].t - expected) < 1e-7);
      expected += i % 2 == 0 ? contact : flight;
    }
    CHECK(result.events.size() > 12);
    CHECK(result.report.audit.energy.value < 1e-7 * result.report.audit.energy_scale);
  }
}

TEST_CASE("two runs give the same events to the last bit") {
  const std::string text = matrix_scene(
      "t_end = 30.0\ninitial = { u = [0.0], v = [0.0] }", "mass = [[1.0]]\nstiffness = [[1.0]]",
      "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = 0.8",
      "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 1.0\nhistory = { type = \"harmonic\", omega "
      "= 0.5 }\n");
  for (const std::string& engine : locating_engines) {
    const Result a = run_text(text, engine), b = run_text(text, engine);
    REQUIRE(a.events.size() == b.events.size());
    for (std::size_t i = 0; i < a.events.size(); ++i) {
      CHECK(a.events[i].t == b.events[i].t);
      CHECK(a.events[i].T_after == b.events[i].T_after);
    }
  }
}

TEST_CASE("horizontal pulse on the frictionless pipeline: final drift is impulse / (mass alpha)") {
  const Scene scene = read_scene(SIGNORINI_MODELS "/pipeline.toml", {{"contacts.*.friction", "0"},
                                                                     {"loads.1.direction", "[1.0, 0.0]"},
                                                                     {"run.t_end", "2.0"},
                                                                     {"run.output_dt", "2.0"},
                                                                     {"run.rtol", "1e-6"}});
  const Model model = build_model(scene);
  const Result result = simulate(model, scene.run);
  const double mass = 0.4 * 24.0, impulse = 100.0 * 0.1;
  const double drift = result.rows.back().u[0] - result.rows.front().u[0];
  CHECK(drift == doctest::Approx(impulse / (mass * model.alpha)).epsilon(1e-4));
}

TEST_CASE("an initial shear above the friction limit is cut, and the run says so") {
  for (const std::string& engine : locating_engines) {
    const auto run = [&](const char* shear) {
      return run_text(matrix_scene("t_end = 0.1\ninitial = { u = [0.0], v = [0.0] }",
                                   "mass = [[1.0]]\nstiffness = [[0.0]]",
                                   std::string("law = \"slider\"\ntangent = { d0 = 1.0 }\nfriction = 0.5\n"
                                               "normal_force = 2.0\ntangential_stiffness = 1e2\n"
                                               "initial_shear = ") +
                                       shear),
                      engine);
    };
    CHECK(run("1.0").report.warnings.empty());
    const Result cut = run("1.5");
    REQUIRE(cut.report.warnings.size() == 1);
    CHECK(cut.report.warnings[0].find("initial_shear = 1.5 N is above the friction limit") !=
          std::string::npos);
    CHECK(cut.rows[0].contacts[0].T == doctest::Approx(1.0));
  }
}

TEST_CASE("a surface that shakes under a slow body: every reversal, though the body's own motion is smooth") {
  for (const std::string& engine : locating_engines) {
    const Result result = run_text(
        matrix_scene("t_end = 6.0\ninitial = { u = [0.0], v = [0.5] }", "mass = [[1.0]]\nstiffness = [[0.0]]",
                     "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = 1e-6\n"
                     "surface_velocity = { type = \"harmonic\", omega = 50.0, amplitude = 1.0 }"),
        engine, "1e-8");
    CHECK(result.events.size() == 96);
  }
}

TEST_CASE("a smooth table of the surface's velocity shakes nothing loose at its points") {
  for (const std::string& engine : locating_engines) {
    const Result result = run_text(
        matrix_scene(
            "t_end = 6.0\ninitial = { u = [0.0], v = [0.1] }", "mass = [[1.3]]\nstiffness = [[10.0]]",
            "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 100.0\nfriction = 0.5\n"
            "surface_velocity = { type = \"table\", interpolation = \"steffen\", times = [0.0, 0.36, 0.79, "
            "1.72, 2.15, 3.33, 4.1, 5.2, 6.5], values = [0.1, 0.907, 0.313, 0.269, 0.166, 0.05, 0.4, 0.3, "
            "0.1] }"),
        engine, "1e-8");
    CHECK(result.events.empty());
  }
}

TEST_SUITE_END();
