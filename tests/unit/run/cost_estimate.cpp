#include "run/cost_estimate.hpp"

#include <doctest/doctest.h>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

constexpr double patience = 0.1;

double seconds_of_belt(const std::string& t_end, Engine engine) {
  const Scene scene = read_scene(SIGNORINI_MODELS "/belt.toml", {{"run.t_end", t_end}});
  return run::seconds_by_trial(build_model(scene), scene.run, engine, patience);
}

}  // namespace

TEST_SUITE_BEGIN("unit/run/cost_estimate");

TEST_CASE(
    "a run that is over within the trial took what it took; of a longer one the rest goes on at its later "
    "pace") {
  CHECK(seconds_of_belt("1.0", Engine::ida) > 0.0);
  CHECK(seconds_of_belt("1e6", Engine::ida) > 1.0);
  CHECK(run::extrapolated_seconds(10.0, {0.5, 1.0}, {1.0, 1.25}) == 1.25 + 9.0 * 0.25 / 0.5);
  CHECK(run::extrapolated_seconds(10.0, {1.0, 1.25}, {1.0, 1.25}) ==
        12.5);  // no more than the start was seen
  CHECK(run::extrapolated_seconds(10.0, {}, {}) == 0.0);
}

TEST_CASE("a trial that sees no more than the start leaves the estimate to the rule") {
  const Scene scene = read_scene(SIGNORINI_MODELS "/belt.toml", {{"run.t_end", "1e6"}});
  const Model model = build_model(scene);
  for (const Engine engine : {Engine::exact, Engine::ida}) {
    RunSpec run = scene.run;
    run.engine = engine;
    CHECK(run::seconds_by_trial(model, scene.run, engine, 0.0) ==
          run::expected_cost(model, run).estimate.seconds);
  }
}

TEST_CASE("an engine that does not take the scene is not tried") {
  const Scene scene =
      read_scene(SIGNORINI_MODELS "/belt.toml",
                 {{"contacts.belt.friction", "{ static = 1.5, kinetic = 1.0, stribeck_velocity = 0.5 }"},
                  {"run.t_end", "1.0"}});
  const std::vector<run::Trial> list = run::trials(scene, build_model(scene), Engine::ida, {}, patience);
  REQUIRE(list.size() == 1);
  CHECK(list[0].engine == Engine::ida);
}

TEST_CASE("what is quicker is said where it is four times and seconds quicker") {
  const std::vector<run::Trial> rack = {
      {Engine::exact, 0.0, 36.2}, {Engine::ida, 0.0, 4.93}, {Engine::exact, 100.0, 1.5}};
  CHECK(run::trial_text(rack) ==
        "exact 36 s, ida 4.9 s; with [reduction] cutoff_frequency = 100: exact 1.5 s");
  CHECK(run::faster_engine_advice(rack, Engine::exact, 36.0).starts_with("exact is expected to take 36 s"));
  CHECK(run::faster_engine_advice(rack, Engine::ida, 4.9).empty());  // nobody waits for that
  CHECK(run::faster_engine_advice({rack[0]}, Engine::exact, 36.0).empty());
  CHECK(run::faster_engine_advice({}, Engine::exact, 36.0).empty());
}

TEST_CASE("a cutoff is tried where the highest frequency is far above the lowest") {
  CHECK(run::cutoff_to_try(6.2832 * 2.0, 6.2832 * 5000.0) == doctest::Approx(100.0));
  CHECK(run::cutoff_to_try(6.2832 * 2.0, 6.2832 * 300.0) == 0.0);
  CHECK(run::cutoff_to_try(0.0, 1e6) == 0.0);
}

TEST_SUITE_END();
