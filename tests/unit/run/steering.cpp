#include "run/steering.hpp"

#include <doctest/doctest.h>

#include "run/choose_engine.hpp"
#include "signorini/error.hpp"

namespace signorini::tests::steerings {
namespace {

/// A heavy beam on two feet with one load of each kind.
Model loaded() {
  return build_model(parse_scene(R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
gravity = [0.0, -9.81]
[run]
t_end = 1.0
[sections.s]
EA = 1e5
EI = 1e3
mass_per_length = 2.0
[nodes]
A = [0.0, 0.0]
B = [3.0, 0.0]
[[members]]
nodes = ["A", "B"]
section = "s"
thermal_expansion = 1e-5
temperature = 10.0
[[supports]]
node = "A"
fix = ["ux", "uy", "rz"]
[[loads]]
name = "push"
node = "B"
direction = [0.0, 1.0]
amplitude = 3.0
[[loads]]
name = "twist"
node = "B"
moment = 2.0
[[loads]]
name = "snow"
nodes = ["A", "B"]
direction = [0.0, -1.0]
distributed = 5.0
)",
                                 "test.toml"));
}

}  // namespace

TEST_SUITE_BEGIN("unit/run/steering");

TEST_CASE("forces, moments and distributed loads may be changed on the way; weight and heat may not") {
  Model model = loaded();
  RunSpec run;
  run.engine = Engine::ida;
  const run::EngineRow& engine = run::engine_row(Engine::ida);
  const Method method = engine.method(model, run);
  run::LoadChanges changes(model, run, engine, method);
  changes.set_time(0.5);
  long given = 0, others = 0;
  for (const std::string name : {"push", "twist", "snow"}) {
    CAPTURE(name);
    changes.set_load(name, History::constant(7.0));
    for (const Load& load : model.loads)
      if (load.name == name) {
        ++given;
        CHECK(load.history.value(1.0) == 7.0);
        CHECK(load.history.piece_before(0.5).value(0.5) != 7.0);
      }
    changes.apply();
    const run::LoadChanges::Change change = changes.change();
    CHECK(change.any);
    CHECK(change.jump);
  }
  CHECK(given == 3);
  for (const Load& load : model.loads)
    if (load.kind == LoadKind::weight || load.kind == LoadKind::temperature) {
      ++others;
      CAPTURE(load.name);
      CHECK_THROWS_AS(changes.set_load(load.name, History::constant(7.0)), SceneError);
    }
  CHECK(others == 2);
  changes.apply();
  CHECK_FALSE(changes.change().any);
  changes.set_load("push", History::constant(7.0));  // as it is already
  changes.apply();
  const run::LoadChanges::Change same = changes.change();
  CHECK(same.any);
  CHECK_FALSE(same.jump);
}

TEST_SUITE_END();

}  // namespace signorini::tests::steerings
