// Engines and decisions in other units. By powers of two every number is exact, so each step and each event is the same to
// the last bits: a constant with a unit that is not of the scene, or a product that should be a quotient, changes them.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include "model/internal_units.hpp"
#include "unit/engine/stretch.hpp"

namespace signorini::tests::units {
namespace {

struct Way {
  std::vector<double> ends;  // of steps, in the time of the scene
  std::vector<contact::ContactStates> modes;
  Vector u;
  std::string reason;
};

Way way(const Scene& scene, const Factors& factors, std::size_t most_events) {
  RunSpec run = scene.run;
  run.t_end *= factors.time;
  if (run.dt) *run.dt *= factors.time;
  Stretch stretch(model::rescaled(build_model(scene), factors), run);
  Way result;
  if (!stretch.decision.consistent) return result;
  result.modes.push_back(stretch.decision.states);
  while (result.modes.size() <= most_events) {
    const engine::Step last =
        stretch.go([&](const engine::Step& step) { result.ends.push_back(step.end / factors.time); });
    result.reason = last.reason;
    if (last.kind != engine::Step::Kind::event || !stretch.pass(last)) break;
    result.modes.push_back(stretch.decision.states);
  }
  result.u = stretch.model.physical(stretch.decision.u) / factors.length;
  return result;
}

const std::string head =
    "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n";

/// A block that is thrown onto a floor with friction, on a spring, beside a wall.
const std::string thrown = head + R"(gravity = [0.3, -9.81]
[run]
t_end = 2.0
initial = { A = { ux = 0.01, uy = 0.2, vx = 1.3, vy = -0.4 } }
[nodes]
A = [0.0, 0.0]
[[masses]]
node = "A"
mass = 1.7
[[springs]]
node = "A"
direction = [1.0, 0.1]
stiffness = 31.0
[[contacts]]
name = "floor"
node = "A"
law = "rigid"
normal = [0.04, 1.0]
restitution = 0.4
friction = 0.3
[[contacts]]
name = "wall"
node = "A"
law = "compliant"
normal = [-1.0, 0.05]
gap = 0.07
normal_stiffness = 4e3
normal_damping = 3.0
tangential_stiffness = 2e3
friction = 0.2
)";

/// Two masses on sliders, one of which sticks rigidly, dragged by a harmonic load.
const std::string dragged = head + R"([run]
t_end = 6.0
initial = { u = [0.3, -0.1], v = [0.2, 0.0] }
[matrices]
mass = [[2.0, 0.3], [0.3, 1.0]]
damping = [[0.1, 0.0], [0.0, 0.2]]
stiffness = [[40.0, -15.0], [-15.0, 30.0]]
[[contacts]]
name = "a"
law = "slider"
tangent = { d0 = 1.0 }
normal_force = 3.0
friction = { static = 0.5, kinetic = 0.4 }
[[contacts]]
name = "b"
law = "slider"
tangent = { d1 = 1.0, d0 = 0.2 }
normal_force = 2.0
tangential_stiffness = 200.0
friction = 0.3
[[loads]]
direction = { d0 = 1.0 }
amplitude = 9.0
history = { type = "harmonic", omega = 5.0 }
)";

void check_units(const std::string& text, const std::string& engine, const std::vector<Override>& more = {}) {
  CAPTURE(engine);
  std::vector<Override> changes{{"run.engine", engine}, {"run.dt", "2e-3"}, {"run.rtol", "1e-7"}};
  changes.insert(changes.end(), more.begin(), more.end());
  const Scene scene = parse_scene(text, "test.toml", changes);
  // Hits that follow each other amplify what IDA's own square roots and powers round.
  const bool ida = engine == "ida";
  const std::size_t most_events = ida ? 8 : 40;
  const Way here = way(scene, {}, most_events);
  CAPTURE(here.reason);
  REQUIRE(here.modes.size() > 3);
  for (const Factors& factors : {Factors{0x1p9, 0x1p-14, 0x1p3}, Factors{0x1p-11, 0x1p8, 0x1p-6}}) {
    CAPTURE(factors.length);
    const Way there = way(scene, factors, most_events);
    for (std::size_t i = 0; i < std::min(there.ends.size(), here.ends.size()); ++i) {
      CAPTURE(i);
      REQUIRE(std::abs(there.ends[i] - here.ends[i]) <= (ida ? 1e-7 : 1e-11) * here.ends[i]);
    }
    CHECK(there.ends.size() == here.ends.size());
    CHECK(there.modes.size() == here.modes.size());
    for (std::size_t i = 0; i < std::min(here.modes.size(), there.modes.size()); ++i)
      CHECK(contact::states_of(there.modes[i]) == contact::states_of(here.modes[i]));
    CHECK((there.u - here.u).norm() <= (ida ? 1e-5 : 1e-9) * here.u.norm());
  }
}

}  // namespace

TEST_SUITE_BEGIN("unit/engine/units");

TEST_CASE("every engine takes the same steps and finds the same events in other units") {
  for (const std::string engine : {"exact", "ida", "newmark"}) {
    check_units(thrown, engine);
    check_units(dragged, engine);
  }
  check_units(dragged, "friction-iteration");
}

TEST_CASE("doubled steps of newmark have the same lengths in other units") {
  check_units(dragged, "newmark", {{"run.step", "doubling"}, {"run.rtol", "1e-4"}, {"run.dt", "5e-2"}});
}

TEST_SUITE_END();

}  // namespace signorini::tests::units
