// Nobody but ForceLayout knows where the forces of a contact stand: with an unused place behind those of each contact, so
// that N of contact c is the force 3 c, runs are the same.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "run/engines.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

struct Case {
  std::string file;
  std::vector<Override> changes = {};
};

/// Scenes of more than one contact: with the first one alone, places are the same.
const std::vector<Case> cases{
    {SIGNORINI_MODELS "/pipeline.toml", {{"run.t_end", "0.6"}}},
    {SIGNORINI_MODELS "/lift-off.toml"},
    {SIGNORINI_MODELS "/matrices.toml"},
    {SIGNORINI_MODELS "/rigid-frame.toml"},
    {SIGNORINI_MODELS "/chain.toml", {{"run.t_end", "3.0"}, {"run.frames", "[0.0]"}}},
    {SIGNORINI_TEST_DATA "/cases/05b_two_mass_symmetric.toml"},
    {SIGNORINI_TEST_DATA "/cases/05g_two_mass_compliant.toml"},
    {SIGNORINI_TEST_DATA "/cases/08b_lumped_singular_M.toml"},
};

struct Run {
  Result result;
  Report report;
};

/// Nothing: the engine does not take the scene.
std::optional<Run> run_with(const Scene& scene, Engine engine, std::size_t unused) {
  Model model = build_model(scene);
  model.layout.unused = unused;
  RunSpec spec = scene.run;
  spec.engine = engine;
  if (engine == Engine::newmark && !spec.dt) spec.dt = 1e-3 * spec.t_end;
  try {
    run::engine_row(spec.engine).refuse(model, spec);
  } catch (const SceneError&) {
    return std::nullopt;
  }
  Run run;
  run.report = simulate(model, spec, run.result);
  return run;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/force_layout");

TEST_CASE("Results do not depend on where forces stand") {
  int runs = 0;
  std::size_t events = 0;
  for (const Case& c : cases)
    for (const Engine engine : {Engine::exact, Engine::ida, Engine::newmark}) {
      CAPTURE(c.file);
      CAPTURE(std::string(to_string(engine)));
      const Scene scene = read_scene(c.file, c.changes);
      const auto is = run_with(scene, engine, 0), spread = run_with(scene, engine, 1);
      REQUIRE(is.has_value() == spread.has_value());
      if (!is) continue;
      ++runs;
      CHECK(spread->report.outcome.kind == is->report.outcome.kind);
      CHECK(spread->report.law_checks.violated == is->report.law_checks.violated);
      const double near = (engine == Engine::ida ? 1e2 * scene.run.rtol : 1e-9) * scene.run.t_end;
      REQUIRE(spread->result.events.size() == is->result.events.size());
      events += is->result.events.size();
      for (std::size_t i = 0; i < is->result.events.size(); ++i) {
        const Event &a = is->result.events[i], &b = spread->result.events[i];
        CHECK(b.type == a.type);
        CHECK(b.contact == a.contact);
        CHECK(std::abs(b.t - a.t) <= near);
      }
    }
  CHECK(runs >= 15);
  CHECK(events >= 100);
}

TEST_SUITE_END();
