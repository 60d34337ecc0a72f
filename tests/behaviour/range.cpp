// Motions and times at the ends of the range of numbers: every engine ends, and says why.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "signorini/engine.hpp"
#include "signorini/simulate.hpp"
#include "study/check/check.hpp"

using namespace signorini;

namespace {

const std::string folder = SIGNORINI_TEST_DATA "/scenes/robust/";

Result run_scene(const std::string& name, const std::string& engine, const std::string& dt) {
  const Scene scene = read_scene(folder + name + ".toml", {{"run.engine", engine}, {"run.dt", dt}});
  return simulate(build_model(scene), scene.run);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/range");

TEST_CASE("a motion that grows beyond the range of numbers ends the run where it does") {
  for (const EngineInfo& name : all_engines) {
    const std::string engine(name.name);
    CAPTURE(engine);
    const Outcome outcome = run_scene("growth", engine, "1e-2").report.outcome;
    CHECK(outcome.kind == Outcome::Kind::stopped);
    // 0.01 cosh(10 t) is the greatest double at t = 71.5.
    CHECK(outcome.t > 70.5);
    CHECK(outcome.t < 71.6);
  }
}

TEST_CASE("a load of 6e300 newtons a second for a hundred seconds") {
  for (const EngineInfo& name : all_engines) {
    const std::string engine(name.name);
    CAPTURE(engine);
    CHECK(run_scene("hang-slider", engine, "1e-2").report.outcome.kind == Outcome::Kind::done);
  }
}

TEST_CASE("a start whose energy is beyond the range of numbers is refused, and one below it runs") {
  for (const EngineInfo& name : all_engines)
    for (const bool beyond : {false, true}) {
      const std::string engine(name.name);
      CAPTURE(engine);
      CAPTURE(beyond);
      const Scene scene = read_scene(SIGNORINI_MODELS "/oscillator.toml",
                                     {{"run.engine", engine},
                                      {"run.dt", "1e-2"},
                                      {"run.t_end", "0.1"},
                                      {"run.initial.mass.ux", beyond ? "1e300" : "1e100"}});
      const Outcome outcome = simulate(build_model(scene), scene.run).report.outcome;
      CHECK(outcome.kind == (beyond ? Outcome::Kind::stopped : Outcome::Kind::done));
      if (beyond) CHECK(outcome.reason == "the energy at the start exceeds the range of doubles");
      if (beyond) CHECK(outcome.t == 0.0);
    }
}

TEST_CASE("times below what engines can divide by: nothing moves in them") {
  for (const EngineInfo& name : all_engines) {
    const std::string engine(name.name);
    CAPTURE(engine);
    const Result shortest = run_scene("tiny-times", engine, "1e-157");
    CHECK(shortest.report.outcome.kind == Outcome::Kind::done);
    CHECK(shortest.report.outcome.t == 1e-155);
    CHECK(shortest.events.empty());
    CHECK(shortest.rows.back().u[0] == 0.0);
    if (name.engine == Engine::friction_iteration) continue;  // it takes no rigid contacts
    // The load that begins at the least positive number acts from then on.
    const Result rocking = run_scene("denormal-start", engine, "1e-4");
    CHECK(rocking.report.outcome.kind == Outcome::Kind::done);
    const Scene plain =
        read_scene(folder + "denormal-start.toml",
                   {{"run.engine", engine}, {"run.dt", "1e-4"}, {"loads.1.history.start", "0.0"}});
    CHECK(rocking.rows.back().u[0] ==
          doctest::Approx(simulate(build_model(plain), plain.run).rows.back().u[0]));
  }
}

TEST_CASE("check ends on all of them") {
  for (const char* name : {"growth", "hang-slider", "tiny-times", "denormal-start"}) {
    CAPTURE(name);
    const Scene scene = read_scene(folder + name + ".toml");
    CHECK(check::check(scene, build_model(scene)).contacts.size() == scene.contacts.size());
  }
}

TEST_SUITE_END();
