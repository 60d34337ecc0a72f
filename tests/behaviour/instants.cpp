// What happens at one instant: jumps on parts without mass, events at the end of the run, energy of drops.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "behaviour/engines.hpp"
#include "behaviour/one_mass.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

/// A mass d0 and a massless d1 on a slider with stiffness, loaded at d1.
std::string massless(const std::string& friction, const std::string& history) {
  return matrix_scene(
      "t_end = 2.0\noutput_dt = 0.1\ninitial = { u = [0.0, 0.0], v = [0.0, 0.0] }",
      "mass = [[1.0, 0.0], [0.0, 0.0]]\nstiffness = [[10.0, -5.0], [-5.0, 10.0]]",
      "law = \"slider\"\ntangent = { d1 = 1.0 }\nnormal_force = 1.0\ntangential_stiffness = 100.0\n"
      "friction = " +
          friction,
      "[[loads]]\ndirection = { d1 = 1.0 }\namplitude = 5.0\nhistory = " + history + "\n");
}

bool balanced(const Result& result, double tolerance) {
  return result.report.audit.energy.value < tolerance * result.report.audit.energy_scale;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/instants");

TEST_CASE(
    "a belt that turns round at once, as fast as before, drags the block off: a jump though speeds are "
    "equal") {
  // m = 1, f N = 0.3: from 1 to -1 at 0.3 a second
  const std::string scene =
      matrix_scene("t_end = 8.0\noutput_dt = 1.0\ninitial = { u = [0.0], v = [1.0] }",
                   "mass = [[1.0]]\nstiffness = [[0.0]]",
                   "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = 0.3\n"
                   "surface_velocity = { type = \"step\", offset = 1.0, amplitude = -2.0, start = 1.0 }",
                   "");
  for (const std::string& engine : locating_engines) {
    CAPTURE(engine);
    const Result result = run_text(scene, engine);
    REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
    std::vector<const Event*> changes;
    for (const Event& event : result.events)
      if (event.contact == 0 && event.from != event.to) changes.push_back(&event);
    REQUIRE(changes.size() == 2);
    CHECK(changes[0]->to == State::slip_plus);
    CHECK(changes[0]->t == doctest::Approx(1.0).epsilon(1e-12));
    CHECK(changes[1]->to == State::stick);
    CHECK(changes[1]->t == doctest::Approx(1.0 + 2.0 / 0.3).epsilon(1e-9));
    CHECK(result.rows.back().v[0] == doctest::Approx(-1.0));
  }
}

TEST_CASE("a load that jumps on a massless slider acts like the limit of a ramp") {
  for (const std::string& engine : locating_engines) {
    const Result jump = run_text(massless("0.3", "{ type = \"rectangle\", start = 0.5, end = 1.5 }"), engine);
    const Result ramp =
        run_text(massless("0.3",
                          "{ type = \"table\", times = [0.0, 0.5, 0.50001, 1.5, 1.50001, 3.0], "
                          "values = [0.0, 0.0, 1.0, 1.0, 0.0, 0.0] }"),
                 engine);
    REQUIRE(jump.report.outcome.kind == Outcome::Kind::done);
    REQUIRE(ramp.report.outcome.kind == Outcome::Kind::done);
    CHECK(jump.rows[16].u[1] == doctest::Approx(ramp.rows[16].u[1]).epsilon(1e-4));  // t = 1.6
    CHECK(jump.events.back().t == doctest::Approx(ramp.events.back().t).epsilon(1e-5));
    CHECK(jump.report.audit.friction_work[0] ==
          doctest::Approx(ramp.report.audit.friction_work[0]).epsilon(1e-3));
    CHECK(balanced(jump, 1e-6));
    CHECK(balanced(ramp, 1e-6));
  }
}

TEST_CASE("friction that drops on a massless slider takes the energy that is released") {
  for (const std::string& engine : locating_engines)
    CHECK(balanced(
        run_text(massless("{ static = 0.4, kinetic = 0.3 }", "{ type = \"harmonic\", omega = 3.0 }"), engine),
        1e-6));
}

TEST_CASE("a compression that ends releases the element's energy as friction") {
  const std::string text =
      matrix_scene("t_end = 2.0\ninitial = { u = [0.5], v = [0.0] }", "mass = [[1.0]]\nstiffness = [[1.0]]",
                   "law = \"slider\"\ntangent = { d0 = 1.0 }\ntangential_stiffness = 10.0\nfriction = 0.3\n"
                   "normal_force = { type = \"rectangle\", start = 0.0, end = 1.0, amplitude = 1.0 }");
  for (const std::string& engine : locating_engines) CHECK(balanced(run_text(text, engine), 1e-6));
}

TEST_CASE("an event exactly at t_end is logged") {
  // pushed by 6 for 0.5 s against 3: stops after one second
  const std::string text =
      matrix_scene("t_end = 1.5\ninitial = { u = [0.0], v = [0.0] }", "mass = [[1.0]]\nstiffness = [[0.0]]",
                   "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 10.0\nfriction = 0.3",
                   "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 6.0\nhistory = { type = \"rectangle\", "
                   "start = 0.5, end = 1.0 }\n");
  for (const std::string& engine : locating_engines) {
    const Result result = run_text(text, engine);
    CHECK(result.events.back().type == EventType::stick);
    CHECK(result.events.back().t == doctest::Approx(1.5).epsilon(1e-12));
    CHECK(result.rows.back().t == 1.5);
  }
}

TEST_CASE("tolerances below the rounding of contact forces do not stop a run") {
  const std::string text = matrix_scene("t_end = 12.0\ninitial = { u = [1.03], v = [0.0] }",
                                        "mass = [[1.0]]\ndamping = [[0.02]]\nstiffness = [[4.0]]",
                                        "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = "
                                        "1.0\nfriction = 0.4\ntangential_stiffness = 1.0e4");
  for (const char* rtol : {"1e-3", "2e-4", "1e-12", "3e-13"}) {
    CAPTURE(rtol);
    const Result result = run_text(text, "ida", rtol);
    CHECK(result.report.outcome.kind == Outcome::Kind::done);
    CHECK(result.events.size() == 10);
  }
}

TEST_CASE(
    "sliders whose forces are not unique share them, but on a point without mass, where the run stops") {
  const auto scene = [](const char* mass, const char* along) {
    const std::string slider =
        fmt::format("law = \"slider\"\ntangent = {{ {} = 1.0 }}\nnormal_force = 1.0\nfriction = 0.4", along);
    return matrix_scene("t_end = 1.0\ninitial = { u = [0.0, 0.0], v = [0.0, 0.0] }",
                        fmt::format("mass = {}\nstiffness = [[2.0, -1.0], [-1.0, 2.0]]", mass), slider,
                        "[[contacts]]\nname = \"other\"\n" + slider +
                            fmt::format("\n[[loads]]\ndirection = {{ {} = 1.0 }}\namplitude = 0.6\n", along));
  };
  const Result shared = run_text(scene("[[1.0, 0.0], [0.0, 1.0]]", "d0"), "ida");
  CHECK(shared.report.outcome.kind == Outcome::Kind::done);
  for (const ContactSample& contact : shared.rows.back().contacts)
    CHECK(contact.T == doctest::Approx(0.3).epsilon(1e-14));
  const Result light = run_text(scene("[[1.0, 0.0], [0.0, 0.0]]", "d1"), "ida");
  CHECK(light.report.outcome.kind == Outcome::Kind::stopped);
  CHECK(light.report.outcome.reason.find("linearly dependent") != std::string::npos);
  CHECK(light.report.outcome.reason.find("contact 'c' sticks rigidly to a massless point; give the contact a "
                                         "tangential_stiffness, or the point a mass") != std::string::npos);
  CHECK(light.report.outcome.refusal.contacts == std::vector<std::size_t>{0, 1});
}

/// Two masses of 1 on sliders that bear 3, pushed by histories of 6.
std::string two_pushed(const std::string& first, const std::string& second) {
  const auto load = [](int dof, const std::string& history) {
    return fmt::format("[[loads]]\ndirection = {{ d{} = 1.0 }}\namplitude = 6.0\nhistory = {{ {} }}\n", dof,
                       history);
  };
  return matrix_scene(
      "t_end = 1.5\ninitial = { u = [0.0, 0.0], v = [0.0, 0.0] }",
      "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[0.0, 0.0], [0.0, 0.0]]",
      "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 3.0\nfriction = 1.0",
      "[[contacts]]\nname = \"q\"\nlaw = \"slider\"\ntangent = { d1 = 1.0 }\nnormal_force = 3.0\n"
      "friction = 1.0\n" +
          load(0, first) + load(1, second));
}

TEST_CASE("a load that begins one rounding before another one's end: both are what they are") {
  // 0.1 + 0.2 = 0.30000000000000004. Slip where 6 sin = 3, a sixth of the pulse; at its end the velocity is
  // 6/w (1 + cos(pi/6)) - 3 (0.2 - 0.2/6), w = 5 pi, and goes down by 3.
  const std::string text = two_pushed("type = \"half_sine\", start = 0.1, duration = 0.2",
                                      "type = \"half_sine\", start = 0.3, duration = 0.2");
  const double left = 6.0 / (5.0 * M_PI) * (1.0 + std::sqrt(0.75)) - 0.5;
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Result result = run_text(text, engine);
    std::vector<double> times[2];
    for (const Event& event : result.events)
      if (event.type != EventType::time) times[event.contact].push_back(event.t);
    for (const int k : {0, 1}) {
      REQUIRE(times[k].size() == 2);
      const double start = k == 0 ? 0.1 : 0.3;
      CHECK(times[k][0] == doctest::Approx(start + 0.2 / 6.0).epsilon(1e-9));
      CHECK(times[k][1] == doctest::Approx(start + 0.2 + left / 3.0).epsilon(1e-9));
    }
  }
}

TEST_CASE("loads that jump within some roundings of each other all jump") {
  for (const int roundings : {1, 2, 8, 40, 300}) {
    CAPTURE(roundings);
    const double later = 0.25 * (1.0 + roundings * 0x1p-52);
    const auto rectangle = [](double start) {
      return fmt::format("type = \"rectangle\", start = {:.17g}, end = 0.5", start);
    };
    for (const bool swapped : {false, true})
      for (const std::string& engine : locating_engines) {
        CAPTURE(engine);
        const Result result = run_text(swapped ? two_pushed(rectangle(later), rectangle(0.25))
                                               : two_pushed(rectangle(0.25), rectangle(later)),
                                       engine);
        int slips = 0;
        for (const Event& event : result.events) {
          if (event.type == EventType::slip) {
            CHECK(event.t == doctest::Approx(0.25).epsilon(1e-12));
            ++slips;
          }
          // 6 against 3 for 0.25, then 3: as long again.
          if (event.type == EventType::stick) CHECK(event.t == doctest::Approx(0.75).epsilon(1e-9));
        }
        CHECK(slips == 2);
      }
  }
}

TEST_CASE("instants that take no time: the refusal names the contacts, and that their states are known") {
  std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\ngravity = [0.0, "
      "-10.0]\n[run]\nt_end = 2.0\nmax_events_at_once = 2\n[nodes]\n";
  const char* names[] = {"A", "B", "C", "far"};
  for (const char* name : names) text += fmt::format("{} = [0.0, 0.0]\n", name);
  for (int i = 0; i < 4; ++i) {
    const double gap = i == 3 ? 0.5 : 1.0 + 1.8e-13 * i;
    text += fmt::format(
        "[[masses]]\nnode = \"{0}\"\nmass = {2}\n[[contacts]]\nname = \"{0}\"\nnode = \"{0}\"\n"
        "law = \"rigid\"\nnormal = [0.0, 1.0]\ngap = {1:.17g}\nrestitution = 0.5\n",
        names[i], gap, i + 1);
  }
  // Bodies that nothing couples run apart, and no one of them stands still: seen by a listener they are one motion.
  CHECK(run_text(text, "exact").report.outcome.kind == Outcome::Kind::done);
  const Scene scene = parse_scene(text, "test.toml", {{"run.engine", "exact"}});
  Result result;
  result.report = simulate(build_model(scene), scene.run, result, [](const DecisionRound&) {});
  const Refusal& refusal = result.report.outcome.refusal;
  CHECK(result.report.outcome.kind == Outcome::Kind::stopped);
  CHECK(refusal.kind == Refusal::Kind::standstill);
  CHECK(refusal.reason == result.report.outcome.reason);
  CHECK(refusal.reason.find("2 events at one instant") != std::string::npos);
  CHECK(refusal.contacts == std::vector<std::size_t>{0, 1, 2});
  CHECK(refusal.condition == doctest::Approx(1.0));  // nothing couples them
  CHECK(refusal.residual == 0.0);
  // The energy at the stop is that of the fall.
  CHECK(balanced(result, 1e-6));
}

TEST_SUITE_END();
