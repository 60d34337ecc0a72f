// Contacts with dashpots and compressions that vary, against closed forms.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "behaviour/engines.hpp"
#include "behaviour/one_mass.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

double bisect(const std::function<double(double)>& f, double lo, double hi) {
  for (int i = 0; i < 200; ++i) {
    const double mid = 0.5 * (lo + hi);
    ((f(lo) > 0.0) == (f(mid) > 0.0) ? lo : hi) = mid;
  }
  return lo;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/dashpot");

TEST_CASE("a mass on a spring and dashpot lets go at N = 0 and never pulls") {
  // m = 1, k = 1e4, c = 40, dropped from 0.2 m: x'' + c x' + k x = -g while in contact
  const double k = 1e4, c = 40.0, g = 9.81, v0 = -std::sqrt(2.0 * g * 0.2), land = -v0 / g;
  const double w = std::sqrt(k), z = c / (2.0 * w), wd = w * std::sqrt(1.0 - z * z), xs = -g / k;
  const double A = -xs, B = (v0 + z * w * A) / wd;
  const auto x = [&](double t) {
    return xs + std::exp(-z * w * t) * (A * std::cos(wd * t) + B * std::sin(wd * t));
  };
  const auto v = [&](double t) {
    return std::exp(-z * w * t) *
           ((B * wd - z * w * A) * std::cos(wd * t) - (A * wd + z * w * B) * std::sin(wd * t));
  };
  const double open = bisect([&](double t) { return -k * x(t) - c * v(t); }, 0.01, 0.0312);
  for (const std::string& engine : engines) {
    const Result result = run_text(
        matrix_scene(
            "t_end = 2.0\ninitial = { u = [0.2], v = [0.0] }", "mass = [[1.0]]\nstiffness = [[0.0]]",
            "law = \"compliant\"\nnormal = { d0 = 1.0 }\nnormal_stiffness = 1.0e4\nnormal_damping = 40.0",
            "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = -9.81\n"),
        engine);
    REQUIRE(result.events.size() > 3);
    CHECK(result.events[0].t == doctest::Approx(land).epsilon(1e-9));
    CHECK(result.events[0].N_after == doctest::Approx(c * v0).epsilon(1e-7));
    CHECK(result.events[1].t == doctest::Approx(land + open).epsilon(1e-8));
    CHECK(result.events[1].type == EventType::separation);
    CHECK(result.events[1].gap < 0.0);
    for (const Result::Row& row : result.rows) CHECK(row.contacts[0].N <= 1e-9);
    CHECK(result.report.audit.energy.value < 1e-7 * result.report.audit.energy_scale);
  }
}

TEST_CASE("a compression that varies: slip begins where f N(t) falls to the load, and ends in closed form") {
  // m = 1, P = 0.3, f = 0.5, N = 1 + 0.5 sin 3t: f N = P at sin 3t = -0.8
  const double begin = (std::numbers::pi + std::asin(0.8)) / 3.0;
  const auto v = [&](double t) {
    return (0.3 - 0.5) * (t - begin) + 0.25 / 3.0 * (std::cos(3.0 * t) - std::cos(3.0 * begin));
  };
  const double end = bisect(v, begin + 0.3, begin + 1.2);
  for (const std::string& engine : engines) {
    const Result result = run_text(
        matrix_scene("t_end = 3.0\ninitial = { u = [0.0], v = [0.0] }", "mass = [[1.0]]\nstiffness = [[0.0]]",
                     "law = \"slider\"\ntangent = { d0 = 1.0 }\nfriction = 0.5\n"
                     "normal_force = { type = \"harmonic\", offset = 1.0, amplitude = 0.5, omega = 3.0 }",
                     "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 0.3\n"),
        engine);
    REQUIRE(result.events.size() == 2);
    CHECK(result.events[0].t == doctest::Approx(begin).epsilon(1e-9));
    CHECK(result.events[1].t == doctest::Approx(end).epsilon(1e-8));
  }
}

TEST_CASE("a slider is lifted while its compression is zero, and carries nothing over") {
  for (const std::string& engine : locating_engines) {
    const Result result = run_text(
        matrix_scene(
            "t_end = 3.0\ninitial = { u = [0.0], v = [0.0] }", "mass = [[1.0]]\nstiffness = [[4.0]]",
            "law = \"slider\"\ntangent = { d0 = 1.0 }\nfriction = 0.5\ntangential_stiffness = 1.0e3\n"
            "normal_force = { type = \"table\", times = [0.0, 1.0, 1.0, 2.0, 2.0, 4.0], values = [2.0, 2.0, "
            "0.0, 0.0, 2.0, 2.0] }",
            "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 0.5\n"),
        engine);
    std::vector<std::string> rows;
    for (const Event& e : result.events)
      if (e.contact == 0) rows.push_back(fmt::format("{} {} {}", e.t, to_string(e.from), to_string(e.to)));
    REQUIRE(rows.size() >= 2);
    CHECK(rows[0] == "1 stick open");
    CHECK(rows[1].substr(0, 7) == "2 open ");
    CHECK(result.report.audit.energy.value < 1e-7 * result.report.audit.energy_scale);
  }
}

TEST_CASE("spring and dashpot along a slider: sticks as a damped oscillator, slips with a lagging element") {
  // m = 1, kt = 100, ct = 4; x(0) = 0.05, stuck: |T| stays below f N = 6
  const double k = 100.0, c = 4.0, w = 10.0, z = c / (2.0 * w), wd = w * std::sqrt(1.0 - z * z);
  const auto stuck = [&](double t) {
    return 0.05 * std::exp(-z * w * t) * (std::cos(wd * t) + z * w / wd * std::sin(wd * t));
  };
  // v(0) = -1 while T slips at +-2: x'' = 2, e' = (-2 - k e)/c, e(0) = 0, and it sticks when x' = e'
  const auto rate = [&](double t) { return -1.0 + 2.0 * t + 2.0 / c * std::exp(-k / c * t); };
  const double sticks = bisect([&](double t) { return -rate(t); }, 0.1, 1.0);
  for (const std::string& engine : engines) {
    const auto run = [&](const char* initial, double friction) {
      return run_text(matrix_scene(std::string("t_end = 2.0\noutput_dt = 0.125\ninitial = ") + initial,
                                   "mass = [[1.0]]\nstiffness = [[0.0]]",
                                   fmt::format("law = \"slider\"\ntangent = {{ d0 = 1.0 }}\nfriction = {}\n"
                                               "normal_force = 10.0\ntangential_stiffness = 100.0\n"
                                               "tangential_damping = 4.0\ninitial_shear = {}\n",
                                               friction, friction > 0.5 ? 5.0 : 0.0)),
                      engine);
    };
    const Result held = run("{ u = [0.05], v = [0.0] }", 0.6);
    CHECK(held.events.empty());
    for (const Result::Row& row : held.rows) {
      CHECK(row.u[0] == doctest::Approx(stuck(row.t)).epsilon(1e-7));
      CHECK(row.contacts[0].ut == row.u[0]);
      CHECK(std::abs(row.contacts[0].slip) < 1e-12);
    }
    const Result slipping = run("{ u = [0.0], v = [-1.0] }", 0.2);
    REQUIRE(!slipping.events.empty());
    CHECK(slipping.events[0].type == EventType::stick);
    CHECK(slipping.events[0].t == doctest::Approx(sticks).epsilon(1e-8));
    CHECK(slipping.events[0].vt == doctest::Approx(-1.0 + 2.0 * sticks).epsilon(1e-7));
    CHECK(slipping.events[0].T == doctest::Approx(-2.0));
    for (const Result* r : {&held, &slipping})
      CHECK(r->report.audit.energy.value < 1e-7 * r->report.audit.energy_scale);
  }
}

TEST_CASE("a landing with dashpots along and across conserves energy, and friction stays in its cone") {
  for (const std::string& engine : locating_engines)
    for (double ct : {0.5, 5.0, 50.0}) {
      CAPTURE(ct);
      const Result result = run_text(
          matrix_scene("t_end = 2.0\ninitial = { u = [0.0, 0.1], v = [0.7, 0.0] }",
                       "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[20.0, 0.0], [0.0, 0.0]]",
                       fmt::format("law = \"compliant\"\nnormal = {{ d1 = 1.0 }}\ntangent = {{ d0 = 1.0 }}\n"
                                   "normal_stiffness = 1.0e4\nnormal_damping = 20.0\nfriction = 0.4\n"
                                   "tangential_stiffness = 5.0e3\ntangential_damping = {}",
                                   ct),
                       "[[loads]]\ndirection = { d1 = 1.0 }\namplitude = -9.81\n"),
          engine);
      CHECK(result.report.outcome.kind == Outcome::Kind::done);
      CHECK(result.report.events_by_type.at("contact") > 3);
      CHECK(result.report.audit.energy.value < 1e-7 * result.report.audit.energy_scale);
      CHECK(result.report.audit.friction.value < 1e-6 * result.report.audit.force_scale);
    }
}

TEST_CASE(
    "a contact that closes again while its dashpot still holds it pressed in keeps the energy balanced") {
  // A short pulse lifts the mass off its dashpot; it is pushed back before the gap has opened.
  for (const std::string& engine : locating_engines)
    for (double cn : {10.0, 30.0, 63.0}) {
      CAPTURE(engine);
      CAPTURE(cn);
      const Result result = run_text(
          matrix_scene("t_end = 2.0\noutput_dt = 0.01\ninitial = { u = [-0.00981], v = [0.0] }",
                       "mass = [[1.0]]\nstiffness = [[0.0]]",
                       fmt::format("law = \"compliant\"\nnormal = {{ d0 = 1.0 }}\nnormal_stiffness = 1.0e3\n"
                                   "normal_damping = {}",
                                   cn),
                       "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = -9.81\n"
                       "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 30.0\n"
                       "history = { type = \"half_sine\", start = 0.1, duration = 0.02 }\n"),
          engine);
      bool again = false;
      for (const Event& e : result.events)
        again = again || (e.type == EventType::contact && e.gap < -1e-6 && e.from == State::open);
      CHECK(again);
      CHECK(result.report.audit.energy.value < 1e-6 * result.report.audit.energy_scale);
    }
}

TEST_CASE("dashpots across and along, two feet coupled by a frame: always a consistent state") {
  for (const std::string& engine : locating_engines)
    for (double cn : {100.0, 400.0, 1000.0})
      for (double ct : {10.0, 100.0, 1000.0}) {
        CAPTURE(engine);
        CAPTURE(cn);
        CAPTURE(ct);
        std::string text =
            "schema = 1\nunits = { force = \"kN\", mass = \"t\", length = \"m\", time = \"s\" }\n"
            "gravity = [0.0, -9.81]\n[run]\nt_end = 1.0\ninitial = \"static\"\n"
            "[sections.s]\nEA = 1.0e6\nEI = 1.0e4\nmass_per_length = 0.1\n"
            "[nodes]\na = [0.0, 0.0]\nb = [0.0, 4.0]\nc = [5.0, 4.0]\nd = [5.0, 0.0]\n"
            "[[members]]\nnodes = [\"a\", \"b\", \"c\", \"d\"]\nsection = \"s\"\nelements = 1\n"
            "[[masses]]\nnode = \"b\"\nmass = 1.0\n"
            "[[loads]]\nnode = \"b\"\ndirection = [1.0, 0.0]\namplitude = 40.0\n"
            "history = { type = \"half_sine\", duration = 0.1 }\n";
        for (const char* node : {"a", "d"})
          text += fmt::format(
              "[[contacts]]\nnode = \"{}\"\nnormal = [0.0, 1.0]\nlaw = \"compliant\"\nnormal_stiffness = "
              "2e4\ntangential_stiffness = 2e4\nfriction = 0.5\nnormal_damping = {}\ntangential_damping = "
              "{}\n",
              node, cn, ct);
        const Result result = run_text(text, engine, "1e-8", "1e-4");
        INFO(result.report.outcome.reason);
        CHECK(result.report.outcome.kind == Outcome::Kind::done);
        CHECK(result.report.audit.energy.value < 1e-4 * result.report.audit.energy_scale);
        CHECK(result.report.audit.friction.value < 1e-4 * result.report.audit.force_scale);
      }
}

TEST_CASE("a part without mass on a dashpot of its own contact creeps, and does not jump") {
  // u1 has neither mass nor damper; the contact's 20 u1' + 100 (u1 - 1) decides it. Value by RK4, step 1e-5.
  for (const std::string& engine : locating_engines) {
    const Result result = run_text(
        matrix_scene("t_end = 0.5\noutput_dt = 0.1\ninitial = { u = [0.0, 0.0], v = [0.0, 0.0] }",
                     "mass = [[1.0, 0.0], [0.0, 0.0]]\nstiffness = [[10.0, -10.0], [-10.0, 11.0]]",
                     "law = \"compliant\"\nnormal = { d1 = 1.0 }\ngap = -1.0\nnormal_stiffness = 100.0\n"
                     "normal_damping = 20.0",
                     "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = -30.0\n"),
        engine);
    CHECK(result.rows[0].u[1] == 0.0);
    CHECK(result.rows.back().u[0] == doctest::Approx(-2.5450).epsilon(1e-5));
    CHECK(result.report.audit.energy.value < 1e-7 * result.report.audit.energy_scale);
  }
}

TEST_CASE("the audit of slip's direction sees the accelerations of its own time") {
  // p' of a compliant contact with a dashpot has g'' in it; that of the last event accused motions that were
  // right, by 0.0034 of the scale.
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Scene scene = read_scene(std::string(SIGNORINI_MODELS) + "/lift-off.toml",
                                   {{"run.engine", engine}, {"contacts.*.friction", "0.55"}});
    const Result result = simulate(build_model(scene), scene.run);
    CHECK(result.report.outcome.kind == Outcome::Kind::done);
    CHECK(result.report.audit.direction.value < 1e-6 * result.report.audit.power_scale);
  }
}

TEST_SUITE_END();
