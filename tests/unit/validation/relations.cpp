// Scenes beside related ones: what is drawn, that each relation holds where nothing is wrong, and that a planted
// difference is noticed in each.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "differential/generator.hpp"
#include "differential/relations.hpp"

using namespace signorini;
using namespace signorini::differential;

namespace {

/// To it all relations apply: a post with a girder without mass, whose end rests on a floor and is shaken.
const char* const shaken = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
gravity = [0.0, -9.81]
[run]
t_end = 0.6
output_dt = 0.005
engine = "exact"
initial = "static"
atol = { displacement = 1e-10, velocity = 1e-9, force = 1e-7 }
[sections]
post = { EA = 1e5, EI = 500.0, mass_per_length = 2.0 }
light = { EA = 5e4, EI = 100.0, mass_per_length = 0.0 }
[damping]
alpha = 3.0
[nodes]
A = [0.0, 0.0]
B = [0.1, 1.5]
C = [1.6, 1.4]
[[members]]
nodes = ["A", "B"]
section = "post"
[[members]]
nodes = ["B", "C"]
section = "light"
[[masses]]
node = "C"
mass = 2.0
[[supports]]
node = "A"
fix = ["ux", "uy", "rz"]
[[springs]]
node = "C"
direction = [0.3, 1.0]
stiffness = 200.0
damping = 1.0
[[contacts]]
name = "floor"
node = "C"
law = "compliant"
normal = [0.1, 1.0]
normal_stiffness = 1e4
tangential_stiffness = 5e3
friction = 0.3
[[loads]]
name = "shaking"
node = "C"
direction = [1.0, 0.4]
amplitude = 60.0
history = { type = "harmonic", start = 0.05, omega = 30.0 }
[[output]]
name = "place"
kind = "displacement"
at = "C"
direction = [0.6, 0.8]
[[output]]
name = "turn"
kind = "velocity"
at = "B"
rotation = true
[[output]]
name = "shake"
kind = "acceleration"
at = "C"
direction = [0.0, 1.0]
[[output]]
name = "moment"
kind = "member_force"
at = ["B", "C"]
quantity = "M"
station = 0.3
[[output]]
name = "pressure"
kind = "contact"
at = "floor"
quantity = "N"
[[output]]
name = "pull"
kind = "spring"
spring = 1
)";

using Plant = std::function<void(Scene&)>;

void each_relation(const RelationJudge& judge, const Plant& plant,
                   const std::function<void(const RelationKind&, const Related&, const Likeness&)>& see) {
  for (const RelationKind& kind : relation_kinds) {
    std::optional<Related> related = kind.of(judge.scene(), 3);
    CAPTURE(std::string(kind.name));
    REQUIRE(related);
    if (plant) plant(related->scene);
    see(kind, *related, judge.compare(*related));
  }
}

}  // namespace

TEST_SUITE("unit/validation/relations") {
  TEST_CASE("relations: a seed is one scene, and some hundred seeds say all that a scene can say") {
    std::set<std::string> missing = {"[[stops]]",
                                     "[[run.stages]]",
                                     "temperature",
                                     "motion = ",
                                     "acceleration = {",
                                     "light",
                                     "normal_damping",
                                     "tangential_damping",
                                     "against = [\"B\"",
                                     "[reduction]",
                                     "[[output]]",
                                     "[[base_motion]]",
                                     "distributed",
                                     "moment = ",
                                     "release",
                                     "rotation_damping",
                                     "restitution",
                                     "static = ",
                                     "surface_velocity",
                                     "initial_strain",
                                     "\"newmark\"",
                                     "\"ida\"",
                                     "\"exact\"",
                                     "[matrices]",
                                     "kind = \"combination\"",
                                     "mass_per_length = 0",
                                     "capture_velocity",
                                     "atol = ",
                                     "initial = \"static\"",
                                     "law = \"slider\""};
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
      const std::string text = draw_whole_scene(seed);
      CHECK(text == draw_whole_scene(seed));
      CAPTURE(seed);
      CHECK_NOTHROW(static_cast<void>(parse_scene(text, "drawn.toml")));
      for (auto it = missing.begin(); it != missing.end();)
        it = text.find(*it) == std::string::npos ? std::next(it) : missing.erase(it);
    }
    CAPTURE(missing.empty() ? std::string() : *missing.begin());
    CHECK(missing.empty());
  }

  TEST_CASE("relations: each holds where nothing is wrong, to the end and within its bounds") {
    const RelationJudge judge(parse_scene(shaken, "shaken.toml"), {});
    REQUIRE(judge.run().events.size() > 7);
    each_relation(judge, {}, [&](const RelationKind& kind, const Related& related, const Likeness& found) {
      CAPTURE(std::string(kind.name));
      CAPTURE(found.what);
      CHECK(found.verdict == Likeness::Class::same);
      // A run that goes on has those after its start; nothing happens within an error of it.
      const auto after =
          std::count_if(judge.run().events.begin(), judge.run().events.end(),
                        [&](const compare::LoggedEvent& event) { return event.t > related.from; });
      CHECK(after > 0);
      CHECK(found.events == static_cast<std::size_t>(after));
    });
  }

  TEST_CASE("relations: a planted difference is noticed in each") {
    const RelationJudge judge(parse_scene(shaken, "shaken.toml"), {});
    const auto noticed = [&](const Plant& plant) {
      each_relation(judge, plant, [](const RelationKind& kind, const Related&, const Likeness& found) {
        CAPTURE(std::string(kind.name));
        CAPTURE(found.what);
        CAPTURE(found.until);
        CHECK(found.verdict == Likeness::Class::unexplained);
      });
    };
    noticed([](Scene& scene) {
      // Both: a kinetic limit above the static one is no scene, and certain to the first slip only.
      scene.contacts.front().friction.static_ *= 1.0 + 1e-8;
      scene.contacts.front().friction.kinetic *= 1.0 + 1e-8;
    });
    noticed([](Scene& scene) { scene.contacts.front().normal_stiffness *= 1.0 + 1e-8; });
    noticed([](Scene& scene) { scene.springs.front().damping *= 1.0 + 1e-6; });
    noticed([](Scene& scene) { scene.loads.front().history.shift += 1e-9; });
  }

  TEST_CASE("relations: what is off in the other run alone is told by its kind") {
    const RelationJudge judge(parse_scene(shaken, "shaken.toml"), {});
    Related itself;
    itself.scene = judge.scene();
    const auto told = [&](const std::function<void(SeenRun&)>& plant) {
      SeenRun other = judge.run();
      plant(other);
      const Likeness found = judge.compare(itself, other);
      return found.verdict == Likeness::Class::unexplained ? found.of : to_string(found.verdict);
    };
    CHECK(told([](SeenRun&) {}) == "same");
    CHECK(told([](SeenRun& run) { run.events[4].t += 1e-9; }) == "time of an event");
    CHECK(told([](SeenRun& run) { run.events.erase(run.events.begin() + 4); }) == "sequence");
    CHECK(told([](SeenRun& run) { run.events[2].to = "closed"; }) == "sequence");
    CHECK(told([](SeenRun& run) { run.rows[50].values[1] += 1e-6; }) == "row");
    CHECK(told([](SeenRun& run) { run.extremes[0].maximum *= 1.0 + 1e-6; }) == "extreme");
    CHECK(told([](SeenRun& run) { run.peaks[0].N *= 1.0 + 1e-6; }) == "peak");
    CHECK(told([](SeenRun& run) {
            run.end = Track::End::stopped;
            run.reason = "no reason";
          }) == "stopped on one side");
    CHECK(told([](SeenRun& run) {
            run.until = 0.3;
            run.rows[110].values[0] += 1.0;
          }) == "certain part ended before");
  }
}
