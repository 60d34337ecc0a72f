// Engines `newmark` and `friction-iteration`: orders of accuracy against the exact flow, event lists at the
// steps named here, laws and balances after every step.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "behaviour/one_mass.hpp"
#include "behaviour/reference.hpp"
#include "signorini/error.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

std::vector<Override> with(const std::string& engine, double dt, std::vector<Override> more = {}) {
  more.push_back({"run.engine", engine});
  more.push_back({"run.dt", fmt::format("{}", dt)});
  return more;
}

Result pipeline(const std::string& engine, double dt, const char* t_end, std::vector<Override> more = {}) {
  more.push_back({"run.t_end", t_end});
  const Scene scene = read_scene(SIGNORINI_MODELS "/pipeline.toml", with(engine, dt, std::move(more)));
  return simulate(build_model(scene), scene.run);
}

double difference(const Result& a, const Result& b) {
  REQUIRE(a.rows.size() == b.rows.size());
  double greatest = 0.0;
  for (std::size_t i = 0; i < a.rows.size(); ++i)
    greatest = std::max(greatest, (a.rows[i].u - b.rows[i].u).cwiseAbs().maxCoeff());
  return greatest;
}

double order(double coarse, double fine) { return std::log2(coarse / fine); }

struct Case {
  const char* name;
  double dt;     // the list is exact from here on; the order is seen between dt/4 and dt/8
  double slope;  // friction-iteration: error of displacements, relative, over the step
};
// 01b needs six steps in its shortest period, 6e-3 s, before its order shows.
constexpr Case cases[] = {{"01a_coulomb_decay_rigid", 0.08, 1.0}, {"01b_coulomb_decay_compliant", 0.01, 1.0},
                          {"02b_belt_fs_gt_fk", 0.08, 1.0},       {"03b_den_hartog_2stop", 0.08, 1.0},
                          {"05b_two_mass_symmetric", 0.08, 1.0},  {"06_point_compliant_kn1e+06", 4e-4, 100.0},
                          {"08b_lumped_singular_M", 0.01, 20.0}};

/// Outputs within their laws to rounding of the greatest force.
void check_laws(const Result& result, double friction) {
  double scale = 0.0;
  for (const Result::Row& row : result.rows)
    for (const ContactSample& c : row.contacts) scale = std::max({scale, std::abs(c.N), std::abs(c.T)});
  for (const Result::Row& row : result.rows)
    for (const ContactSample& c : row.contacts) {
      CHECK(std::abs(c.T) <= friction * std::abs(c.N) + 1e-12 * scale);
      CHECK(c.N <= 1e-12 * scale);
    }
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/newmark");

TEST_CASE("order two without events") {
  // One mass held by a spring, damped, under a harmonic load; a slider far below its limit holds the other.
  const std::string text = matrix_scene(
      "t_end = 10.0\noutput_dt = 1.0\ninitial = { u = [0.3, 0.1], v = [0.0, 0.4] }",
      "mass = [[1.0, 0.2], [0.2, 2.0]]\ndamping = [[0.1, 0.0], [0.0, 0.1]]\nstiffness = [[3.0, -1.0], [-1.0, "
      "2.0]]",
      "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 10.0\nfriction = 0.9\ntangential_stiffness = "
      "7.0",
      "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 2.0\nhistory = { type = \"harmonic\", omega = 1.3 "
      "}\n");
  const Result exact = run_text(text, "exact");
  std::vector<double> errors;
  for (double dt : {0.04, 0.02, 0.01}) {
    const Scene scene = parse_scene(text, "test.toml", with("newmark", dt));
    errors.push_back(difference(simulate(build_model(scene), scene.run), exact));
  }
  for (std::size_t i = 1; i < errors.size(); ++i)
    CHECK(order(errors[i - 1], errors[i]) == doctest::Approx(2.0).epsilon(0.05));
}

TEST_CASE("exact event lists, order two in displacements and event times, energy to rounding") {
  for (const Case& c : cases)
    for (const char* refine : {"root", "linear"}) {
      CAPTURE(c.name);
      CAPTURE(refine);
      std::vector<Comparison> runs;
      for (double part : {1.0, 0.25, 0.125}) {
        runs.push_back(run_case(c.name, with("newmark", part * c.dt, {{"run.refine", refine}})));
        const Comparison& run = runs.back();
        INFO(run.first_difference);
        CHECK(run.result.report.outcome.kind == Outcome::Kind::done);
        CHECK(run.agreeing == run.expected);
        CHECK(run.found == run.expected);
        const Audit& audit = run.result.report.audit;
        if (std::string(refine) == "root") CHECK(audit.energy.value < 1e-11 * audit.energy_scale);
        CHECK(audit.equilibrium.value < 1e-11 * audit.force_scale);
      }
      if (std::string(refine) == "linear") continue;
      CHECK(order(runs[1].displacement, runs[2].displacement) > 1.7);
      CHECK(order(runs[1].event_time, runs[2].event_time) > 1.7);
    }
}

TEST_CASE("rigid contacts: impacts, landings with restitution, and a ball past its accumulation point") {
  for (const auto& [case_name, dt] :
       {std::pair{"04c_impact_oscillator_e0", 0.02}, std::pair{"06_point_rigid_e0.5", 1e-3},
        std::pair{"04a_bouncing_ball", 0.02}}) {
    const std::string name = case_name;  // clang 14 captures no structured binding
    CAPTURE(name);
    const Comparison a = run_case(name, with("newmark", dt)), b = run_case(name, with("newmark", 0.5 * dt));
    for (const Comparison* c : {&a, &b}) {
      INFO(c->first_difference);
      CHECK(c->agreeing == c->expected);
      CHECK(c->found == c->expected);
    }
    if (a.event_time < 1e-12) continue;  // a flight under gravity is exact
    CHECK(order(a.displacement, b.displacement) > 1.9);
    CHECK(order(a.event_time, b.event_time) > 1.9);
  }
}

TEST_CASE("05g: 101 events of two masses on sliders with stiffness at dt = 5e-3") {
  const Comparison c = run_case("05g_two_mass_compliant", with("newmark", 5e-3));
  INFO(c.first_difference);
  CHECK(c.agreeing == 101);
  CHECK(c.found == 101);
}

TEST_CASE("asymptotic orders at small steps: at least 1.9 with localised events") {
  for (const auto& [case_name, dt] :
       {std::pair{"01b_coulomb_decay_compliant", 1.25e-3}, std::pair{"06_point_compliant_kn1e+06", 1e-4},
        std::pair{"03b_den_hartog_2stop", 0.02}}) {
    const std::string name = case_name;  // clang 14 captures no structured binding
    CAPTURE(name);
    const Comparison a = run_case(name, with("newmark", dt)), b = run_case(name, with("newmark", 0.5 * dt));
    CHECK(order(a.displacement, b.displacement) > 1.9);
    CHECK(order(a.event_time, b.event_time) > 1.9);
  }
}

TEST_CASE("laws hold to rounding at every output, also inside steps") {
  for (double dt : {1e-3, 1e-4}) {
    const Result result = pipeline("newmark", dt, "0.3", {{"run.output_dt", "0.00037"}});
    CHECK(result.report.outcome.kind == Outcome::Kind::done);
    check_laws(result, 0.3);
    if (dt < 1e-3) CHECK(result.report.audit.energy.value < 1e-10 * result.report.audit.energy_scale);
    CHECK(result.report.audit.friction.value < 1e-12 * result.report.audit.force_scale);
  }
}

TEST_CASE("a step without events is one solve, and modes that come back cost no factorisation") {
  const Result result = pipeline("newmark", 1e-5, "0.0019");  // before the first event
  const Counters& c = result.report.counters;
  CHECK(c.steps == 190);
  CHECK(c.solves == c.steps);
  const Comparison cycle = run_case("02b_belt_fs_gt_fk", with("newmark", 0.01));
  CHECK(cycle.result.report.counters.factorisations < 40);
}

TEST_CASE("the pipeline at coarse steps: it never diverges, and begins as it should") {
  for (double dt : {1e-2, 1e-3, 1e-4}) {
    const Result result = pipeline("newmark", dt, "1.2", {{"run.output_dt", "0.1"}});
    CAPTURE(dt);
    CHECK(result.report.outcome.kind == Outcome::Kind::done);
    CHECK(result.report.peaks[0].tangential < 0.045);
    CHECK(result.report.audit.energy.value < 1e-10 * result.report.audit.energy_scale);
  }
  const Result fine = pipeline("newmark", 1e-6, "0.003", {{"run.output_dt", "0.001"}});
  REQUIRE(fine.events.size() >= 2);
  CHECK(fine.events[0].t == doctest::Approx(1.9393367e-3).epsilon(1e-6));
  CHECK(fine.events[1].t == doctest::Approx(2.63105425e-3).epsilon(1e-6));
}

TEST_CASE("two crossings inside one step are seen") {
  // T of a stuck slider follows its load, which exceeds the limit for 0.42 s around t = pi/2.
  const std::string text =
      matrix_scene("t_end = 3.0\noutput_times = [3.0]\ninitial = { u = [0.0], v = [0.0] }",
                   "mass = [[1.0]]\nstiffness = [[100.0]]",
                   "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 10.0\nfriction = "
                   "0.9\ntangential_stiffness = 1e4",
                   "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 9.3\nhistory = { type = \"harmonic\", "
                   "omega = 1.0 }\n");
  const Result exact = run_text(text, "exact");
  REQUIRE(!exact.events.empty());
  for (double dt : {0.5, 0.3}) {
    CAPTURE(dt);
    const Scene scene = parse_scene(text, "test.toml", with("newmark", dt));
    const Result result = simulate(build_model(scene), scene.run);
    REQUIRE(!result.events.empty());
    CHECK(result.events[0].to == exact.events[0].to);
    CHECK(std::abs(result.events[0].t - exact.events[0].t) < 0.1);
  }
}

TEST_CASE("step doubling follows the tolerance") {
  std::vector<double> errors;
  for (const char* rtol : {"1e-4", "1e-6", "1e-8"}) {
    const Comparison c = run_case("03b_den_hartog_2stop",
                                  with("newmark", 0.08, {{"run.step", "doubling"}, {"run.rtol", rtol}}));
    CHECK(c.agreeing == 32);
    CHECK(c.found == 32);
    errors.push_back(c.displacement);
  }
  CHECK(errors[0] > 5.0 * errors[1]);
  CHECK(errors[1] > 5.0 * errors[2]);
  CHECK(errors[2] < 1e-5);
}

TEST_CASE("the step is asked for, by name and place") {
  for (const char* engine : {"newmark", "friction-iteration"}) {
    try {
      (void)read_scene(SIGNORINI_MODELS "/pipeline.toml", {{"run.engine", engine}});
      FAIL("no refusal");
    } catch (const std::exception& e) {
      CHECK(std::string(e.what()).find("run.dt") != std::string::npos);
      CHECK(std::string(e.what()).find(engine) != std::string::npos);
    }
    Scene scene = read_scene(SIGNORINI_MODELS "/pipeline.toml");
    scene.run.engine = std::string(engine) == "newmark" ? Engine::newmark : Engine::friction_iteration;
    CHECK_THROWS_AS((void)simulate(build_model(scene), scene.run), SceneError);
  }
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("behaviour/friction-iteration");

TEST_CASE("it agrees with newmark to the first order of the step") {
  for (const Case& c : cases) {
    CAPTURE(c.name);
    for (double part : {0.5, 0.125}) {
      const Comparison a = run_case(c.name, with("friction-iteration", part * c.dt));
      CHECK(a.result.report.outcome.kind == Outcome::Kind::done);
      CHECK(a.displacement < c.slope * part * c.dt);
    }
  }
}

TEST_CASE("forces keep to their laws at every output, and events stand at ends of steps") {
  const double dt = 1e-4;
  const Result result = pipeline("friction-iteration", dt, "0.3", {{"run.output_dt", "0.00037"}});
  CHECK(result.report.outcome.kind == Outcome::Kind::done);
  check_laws(result, 0.3);
  for (const Event& e : result.events) {
    const double steps = e.t / dt;
    CHECK(std::abs(steps - std::round(steps)) < 1e-6);
  }
  const Result newmark = pipeline("newmark", dt, "0.3", {{"run.output_dt", "0.00037"}});
  CHECK(difference(result, newmark) < 2e-4);
}

TEST_CASE("rigid contacts are refused by name") {
  const Scene scene =
      read_scene(SIGNORINI_TEST_DATA "/cases/04a_bouncing_ball.toml", with("friction-iteration", 0.01));
  CHECK_THROWS_WITH_AS((void)simulate(build_model(scene), scene.run), doctest::Contains("is rigid"),
                       SceneError);
}

TEST_CASE("an iteration that does not end stops the run, and says where and why") {
  const Result result =
      pipeline("friction-iteration", 1e-2, "1.2", {{"contacts.*.friction", "1.3"}, {"run.output_dt", "0.1"}});
  CHECK(result.report.outcome.kind == Outcome::Kind::stopped);
  const std::string& reason = result.report.outcome.reason;
  CHECK(reason.find("friction iteration does not converge") != std::string::npos);
  CHECK(reason.find("'first'") != std::string::npos);
  CHECK(reason.find("t = ") != std::string::npos);
}

TEST_SUITE_END();
