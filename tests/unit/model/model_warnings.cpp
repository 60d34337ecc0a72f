#include "model/model_warnings.hpp"

#include <doctest/doctest.h>

#include <string>

#include "behaviour/scene_parts.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

using Changes = std::vector<Override>;

std::vector<std::string> doubts_of(const std::string& name, const Changes& changes = {}) {
  return build_model(read_scene(SIGNORINI_TEST_DATA "/scenes/robust/" + name + ".toml", changes)).warnings;
}

bool says(const std::vector<std::string>& doubts, const std::string& words) {
  return std::any_of(doubts.begin(), doubts.end(),
                     [&](const std::string& d) { return d.find(words) != std::string::npos; });
}

}  // namespace

TEST_SUITE_BEGIN("unit/model/model_warnings");

TEST_CASE("a load along what a support holds") {
  CHECK(
      says(doubts_of("load-on-held"), "load 1 acts only along directions that supports or rigid bodies fix"));
  CHECK(doubts_of("load-on-held", {{"loads.1.amplitude", "0.0"}}).empty());
  CHECK(doubts_of("load-on-held", {{"loads.1.direction", "[1.0, 1.0]"}}).empty());
}

TEST_CASE("initial values that equilibrium decides are named with their line") {
  const std::string path = SIGNORINI_TEST_DATA "/scenes/massless/initial.toml";
  const auto found = build_model(read_scene(path, {})).warnings;
  REQUIRE(found.size() == 2);
  CHECK(says(found, path + ":6:"));
  CHECK(says(found, "run.initial.p.ux: the initial value 0.3 is ignored: p.ux has no mass and no damper"));
  CHECK(says(found, "run.initial.p.vx: the initial value 5 is ignored: p.ux has no mass"));
  // A damper begins from the displacement, and knows no velocity either; what has mass knows both.
  const auto damped = build_model(read_scene(path, {{"springs.2.damping", "1.0"}})).warnings;
  REQUIRE(damped.size() == 1);
  CHECK(says(damped, "run.initial.p.vx"));
  CHECK(build_model(read_scene(path, {{"run.initial", "{ m = { ux = 0.3, vx = 5.0 } }"}})).warnings.empty());
}

TEST_CASE("initial values of a matrix scene, in other units") {
  const auto found = build_model(parse_scene(R"(schema = 1
units = { force = "MN", mass = "t", length = "mm", time = "ms" }
[run]
t_end = 1.0
initial = { u = [1.0, 0.25], v = [0.0, -3.5] }
[matrices]
mass = [[1.0, 0.0], [0.0, 0.0]]
stiffness = [[1e3, -1e2], [-1e2, 2e3]]
[[contacts]]
name = "c"
law = "compliant"
normal = { d0 = 1.0 }
normal_stiffness = 1e3
gap = 0.1
)",
                                             "test.toml"))
                         .warnings;
  CHECK(says(found, "test.toml:5:"));
  CHECK(says(found, "run.initial.u[1]: the initial value 0.25 is ignored"));
  CHECK(says(found, "run.initial.v[1]: the initial value -3.5 is ignored"));
}

TEST_CASE("a body whose contacts lie on the wrong side falls away from them") {
  const auto fallen = doubts_of("wrongnormal");
  CHECK(says(fallen, "the static loads accelerate the structure away from contacts 'left' and 'right'"));
  CHECK_FALSE(says(fallen, "suddenly"));
  CHECK_FALSE(says(doubts_of("wrongnormal", {{"contacts.*.normal", "[0.0, 1.0]"}}), "fall"));
  CHECK_FALSE(says(doubts_of("wrongnormal", {{"gravity", "[0.0, 0.0]"}}), "fall"));
}

TEST_CASE("weight that comes at t = 0") {
  CHECK(says(doubts_of("settle"), "suddenly at t = 0 on contacts 'left' and 'right'"));
  CHECK_FALSE(says(doubts_of("settle", {{"run.initial", "static"}}), "suddenly"));
  CHECK_FALSE(says(doubts_of("settle", {{"gravity", "[0.0, 0.0]"}}), "suddenly"));
  CHECK_FALSE(says(doubts_of("settle", {{"contacts.*.gap", "0.1"}}), "suddenly"));
}

TEST_CASE("mass-proportional damping on what slides") {
  CHECK(
      says(doubts_of("pump"), "mass-proportional damping (alpha = 1.077 1/s) also damps rigid-body motions"));
  CHECK(says(doubts_of("pump"), "1/alpha = 0.9284 s"));
  CHECK(doubts_of("load-on-held").size() == 1);
}

TEST_CASE("friction above two") {
  CHECK(says(doubts_of("pump", {{"contacts.left.friction", "30.0"}}), "friction 30 at contact 'left'"));
  CHECK_FALSE(says(doubts_of("pump", {{"contacts.left.friction", "2.0"}}), "ratio of forces"));
}

TEST_CASE("an initial shear that a static start does not carry") {
  CHECK(says(doubts_of("shear0"), "initial_shear at contacts 'left' and 'right' is not in equilibrium"));
  CHECK_FALSE(says(doubts_of("shear0", {{"contacts.*.initial_shear", "0.0"}}), "initial_shear"));
}

TEST_CASE("doubts are the first warnings of a run") {
  const Scene scene = read_scene(SIGNORINI_TEST_DATA "/scenes/robust/load-on-held.toml");
  const Result result = simulate(build_model(scene), scene.run);
  REQUIRE(!result.report.warnings.empty());
  CHECK(result.report.warnings[0].find("load 1 acts only") == 0);
}

TEST_CASE("a pulse that is shorter than the clock can tell") {
  const auto pulse = [](const char* history) {
    return doubts_of("load-on-held", {{"loads.1.direction", "[1.0, 0.0]"}, {"loads.1.history", history}});
  };
  CHECK(says(pulse("{ type = \"rectangle\", start = 0.25, end = 0.25000000000001 }"),
             "'load 1' has a pulse at 0.25 that lasts 9.99e-15, less than the 5e-14"));
  CHECK(pulse("{ type = \"rectangle\", start = 0.25, end = 0.2500000000001 }").empty());
  CHECK(pulse("{ type = \"table\", times = [0.0, 0.25, 0.25000000000001, 2.0], values = [1, 1, 3, 3] }")
            .empty());
  // Of pieces that meet in a peak, of curves, and from the beginning on.
  CHECK(says(pulse("{ type = \"triangle\", start = 0.25, end = 0.25000000000002 }"), "that lasts 2e-14"));
  CHECK(says(pulse("{ type = \"half_sine\", start = 0.25, duration = 5e-15 }"), "that lasts 5"));
  CHECK(says(pulse("{ type = \"half_sine\", start = 0.25, duration = 4e-17 }"),
             "that lasts 5.55e-17"));  // an ulp
  CHECK(says(pulse("{ type = \"half_sine\", start = 0.0, duration = 1e-17 }"), "that lasts 1e-17"));
  CHECK(says(pulse("{ type = \"half_sine\", start = 0.0, duration = 1e-200 }"), "that lasts 1e-200"));
  CHECK(says(pulse("{ type = \"rectangle\", start = 0.0, end = 1e-16 }"), "that lasts 1e-16"));
  CHECK(pulse("{ type = \"half_sine\", start = 0.25, duration = 1e-13 }").empty());
  CHECK(pulse("{ type = \"step\", start = 1e-16 }").empty());
}

TEST_CASE("supports that move at once") {
  using namespace tests::parts;
  const auto held = [](const std::string& motion) {
    return build_model(parse_scene(head + run_table(1.0, 0.1) + section(1e5, 3e3, 0.3) +
                                       nodes({{"A", 0, 0}, {"B", 3, 1}}) +
                                       member("A, B", "mass = \"lumped\"\n") + fixed("A", "ux, rz") +
                                       fixed("A", "uy", "motion = " + motion + "\n"),
                                   "test.toml"))
        .warnings;
  };
  CHECK(says(held("{ type = \"half_sine\", duration = 1.0 }"),
             "the velocity of 'support A.uy' jumps at t = 0"));
  CHECK(says(held("{ type = \"step\" }"), "the motion of 'support A.uy' jumps at t = 0"));
  CHECK(held("{ type = \"polynomial\", coefficients = [0.0, 0.0, 1.0] }").empty());
}

TEST_CASE("heat whose history is not constant is not in a static start") {
  using namespace tests::parts;
  const auto heated = [](const std::string& temperature, const std::string& initial) {
    return build_model(
               parse_scene(
                   head + run_table(1.0, 0.1) + initial + section(1e5, 3e3, 0.3) +
                       nodes({{"A", 0, 0}, {"B", 3, 1}}) +
                       member("A, B", "mass = \"lumped\"\nthermal_expansion = 1.2e-5\ntemperature = " +
                                          temperature + "\n") +
                       fixed("A", "ux, uy, rz"),
                   "test.toml"))
        .warnings;
  };
  const std::string table = "{ type = \"table\", times = [0.0, 1.0], values = [20.0, 20.0], hold = true }",
                    from_zero = "{ type = \"table\", times = [0.0, 1.0], values = [0.0, 20.0], hold = true }",
                    start = "initial = \"static\"\n", slow = "initial = \"frictional\"\n";
  CHECK(says(heated(table, start), "acts suddenly at t = 0"));
  CHECK(says(heated(table, slow), "acts suddenly at t = 0"));
  CHECK(heated(table, slow + "[[run.stages]]\nname = \"hot\"\nloads = [\"temperature\"]\n").empty());
  CHECK(heated(from_zero, start).empty());
  CHECK(heated("20.0", start).empty());
  CHECK_FALSE(says(heated(table, ""), "suddenly"));
}

TEST_CASE("rotations of nodes with which no element turns") {
  const auto found = [](const std::string& more) {
    return build_model(parse_scene(R"(schema = 1
units = { force = "kN", mass = "t", length = "m", time = "s" }
[run]
t_end = 1.0
[sections.beam]
EA = 1e5
EI = 3e3
mass_per_length = 0.3
[nodes]
A = [0.0, 2.0]
B = [2.5, 2.8]
[[members]]
nodes = ["A", "B"]
section = "beam"
[[bodies]]
name = "slab"
rectangle = { size = [1.0, 0.5], degrees = 17.0 }
elements = [2, 1]
E = 2e6
nu = 0.2
density = 2.0
plane = "stress"
points = { p = [0.0, 0.0] }
[[supports]]
nodes = ["slab.bottom", "A"]
fix = ["ux", "uy"]
)" + more,
                                   "test.toml"))
        .warnings;
  };
  const std::string spring = "[[springs]]\nrotation_stiffness = 10.0\nnode = ",
                    inertia = "[[masses]]\nmass = 1.0\ninertia = 0.5\nnode = ",
                    clamp = "[[supports]]\nfix = [\"ux\", \"rz\"]\nnode = ";
  CHECK(says(found(inertia + "\"p\"\n"),
             "inertia at node 'p' has no effect on the structure: no element rotates with it"));
  CHECK(says(found(spring + "\"p\"\n"), "a rotational spring at node 'p'"));
  CHECK(says(found(spring + "\"B\"\nagainst = \"p\"\n"), "a rotational spring at node 'p'"));
  CHECK(says(found(clamp + "\"p\"\n"), "supports.2.fix: rz at node 'p' has no effect"));
  CHECK(found(inertia + "\"B\"\n" + spring + "\"B\"\n" + clamp + "\"B\"\n").empty());
  const std::string body =
      "[[rigid]]\nname = \"r\"\ncentre = \"B\"\nnodes = [\"p\"]\nmass = 1.0\ninertia = 0.1\n";
  CHECK(found(body + spring + "\"p\"\n").empty());
}

TEST_SUITE_END();
