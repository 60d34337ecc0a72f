// Starts that remember how their loads came, and runs that go on from others.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "behaviour/engines.hpp"
#include "behaviour/random_starts.hpp"
#include "behaviour/scene_parts.hpp"
#include "linear/sparse_cholesky.hpp"
#include "model/assembly/springs.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::starts {
namespace {

using parts::head;
using parts::two_sliders;

const std::string frictional = "[run]\nt_end = 1.0\ninitial = \"frictional\"\n";

Model built(const std::string& text, const std::vector<Override>& changes = {}) {
  return build_model(parse_scene(text, "test.toml", changes));
}

std::string refusal(const std::string& text) {
  try {
    (void)built(text);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "none";
}

int dof(const Model& model, const std::string& name) {
  for (std::size_t i = 0; i < model.physical_dofs().size(); ++i)
    if (model.physical_dofs()[i].displacement == name) return static_cast<int>(i);
  FAIL("no degree of freedom " << name);
  return -1;
}

std::string push(const std::string& name, double force) {
  return fmt::format("[[loads]]\nname = \"{}\"\nnode = \"A\"\ndirection = [1.0, 0.0]\namplitude = {}\n", name,
                     force);
}

/// A portal on two feet of this law, under snow of 80 kN, its girder heated by 400 degrees in four steps.
std::string heated_portal(const std::string& law, double friction) {
  std::string text = head + R"([run]
t_end = 0.02
output_dt = 0.01
initial = "frictional"
[[run.stages]]
name = "weight"
loads = ["snow"]
[[run.stages]]
name = "heat"
loads = ["temperature"]
steps = 4
[sections.s]
EA = 2.0e6
EI = 1.0e4
mass_per_length = 0.1
[nodes]
A = [-4.0, 0.0]
B = [-4.0, 4.0]
C = [4.0, 4.0]
D = [4.0, 0.0]
[[members]]
nodes = ["A", "B"]
section = "s"
[[members]]
nodes = ["B", "C"]
section = "s"
elements = 4
thermal_expansion = 1.2e-5
temperature = 400.0
[[members]]
nodes = ["C", "D"]
section = "s"
[[loads]]
name = "snow"
nodes = ["B", "C"]
direction = [0.0, -1.0]
distributed = 10.0
)";
  for (const auto& [name, node] : {std::pair("left", "A"), std::pair("right", "D")})
    text += fmt::format("[[contacts]]\nname = \"{}\"\nnode = \"{}\"\nnormal = [0.0, 1.0]\nfriction = {}\n{}",
                        name, node, friction, law);
  return text;
}

/// What holds since ever and is no contact's.
Vector static_load_of(const Model& model) {
  Vector load = Vector::Zero(model.size());
  for (const Load& l : model.loads)
    if (l.is_static) l.direction.add_to(load, l.history.value(0.0));
  return load;
}

const std::string portal = SIGNORINI_TEST_DATA "/scenes/starts/portal.toml";

}  // namespace

TEST_SUITE_BEGIN("behaviour/frictional_start");

TEST_CASE("two sliders in series: pushed until the first slips, and back until it slips back") {
  // a stuck: u_a = 11 u_b, T_a = 11/12 P, so it slips at P = 6/11; then 10 (a - b) = P - 0.5 = 100 b
  {
    const Model model = built(two_sliders(frictional, push("push", 1.2)));
    REQUIRE(model.statics.events.size() == 1);
    CHECK(model.statics.events[0].fraction == doctest::Approx(6.0 / 11.0 / 1.2).epsilon(1e-13));
    CHECK(model.statics.events[0].to == State::slip_plus);
    CHECK(model.u0[dof(model, "A.ux")] == doctest::Approx(0.077).epsilon(1e-13));
    CHECK(model.u0[dof(model, "B.ux")] == doctest::Approx(0.007).epsilon(1e-13));
    CHECK(model.contacts[0].initial_shear == doctest::Approx(0.5).epsilon(1e-14));
    CHECK(model.contacts[1].initial_shear == doctest::Approx(0.7).epsilon(1e-13));
  }
  // Taken back by 1.5: T_a falls by 11/12 of what is taken and reaches -0.5 at 12/11, then slips back.
  const Model model =
      built(two_sliders(frictional + "[[run.stages]]\nname = \"forth\"\nloads = [\"push\"]\n"
                                     "[[run.stages]]\nname = \"back\"\nloads = [\"pull\"]\nsteps = 2\n",
                        push("push", 1.2) + push("pull", -1.5)));
  const auto& events = model.statics.events;
  REQUIRE(events.size() == 3);
  CHECK(events[1].stage == "back");
  CHECK(events[1].fraction == 0.0);  // it sticks at once
  CHECK(events[1].to == State::stick);
  CHECK(events[2].fraction == doctest::Approx(12.0 / 11.0 / 1.5).epsilon(1e-12));
  CHECK(events[2].to == State::slip_minus);
  // P = -0.3: 10 (a - b) = P + 0.5 = 100 b
  CHECK(model.u0[dof(model, "B.ux")] == doctest::Approx(0.002).epsilon(1e-11));
  CHECK(model.u0[dof(model, "A.ux")] == doctest::Approx(0.022).epsilon(1e-11));
  REQUIRE(model.statics.stages.size() == 3);
  CHECK(model.statics.stages[1].fraction == 0.5);
  // half back: P = 0.45, stuck since P = 1.2, T_a = 0.5 - 11/12 0.75
  CHECK(model.statics.stages[1].T[0] == doctest::Approx(0.5 - 11.0 / 12.0 * 0.75).epsilon(1e-11));
}

TEST_CASE("nothing moves in the run that follows a slow start") {
  const std::string text = two_sliders(frictional, push("push", 1.2));
  for (const std::string& engine : locating_engines) {
    CAPTURE(engine);
    const Scene scene = parse_scene(text, "test.toml", {{"run.engine", engine}, {"run.dt", "1e-2"}});
    const Model model = build_model(scene);
    const Result result = simulate(model, scene.run);
    CHECK(result.report.outcome.kind == Outcome::Kind::done);
    for (const Result::Row& row : result.rows) {
      CHECK((row.u - model.u0).cwiseAbs().maxCoeff() < 1e-12);
      CHECK(std::abs(row.contacts[0].T - 0.5) < 1e-10);
    }
  }
}

TEST_CASE("the portal's feet carry the thrust of the force method, two thirds of their limit") {
  const Model model = build_model(read_scene(portal));
  // Feet free to slide part by h w L^3 / (12 EIb). A unit thrust bends the legs by h^3 / (3 EIc) each and the girder by
  // h^2 L / EIb, shortens the girder by L / EA and both feet's springs by 1 / kt.
  const double w = 3.0 * 9.81, L = 6.0, h = 4.0, EIb = 9.464e4, EIc = 5.286e4, EA = 3.34e6, kt = 1e6;
  const double parting = h * w * L * L * L / (12.0 * EIb);
  const double by_thrust = 2.0 * h * h * h / (3.0 * EIc) + h * h * L / EIb + L / EA + 2.0 / kt;
  const double thrust = parting / by_thrust, heavy = w * L + 2.0 * 0.117 * 9.81 * h;
  CHECK(std::abs(model.contacts[0].initial_shear) == doctest::Approx(thrust).epsilon(1e-9));
  CHECK(model.statics.reactions[0] == doctest::Approx(0.5 * heavy).epsilon(1e-9));
  CHECK(thrust / (0.2 * 0.5 * heavy) == doctest::Approx(2.0 / 3.0).epsilon(0.02));
  CHECK(model.contacts[0].initial_shear == doctest::Approx(-model.contacts[1].initial_shear).epsilon(1e-10));
  CHECK(model.statics.events.empty());
  // All stick: one linear solve.
  Vector weight = Vector::Zero(model.size());
  for (const Load& load : model.loads)
    if (load.name == "gravity") load.direction.add_to(weight, 1.0);
  const Vector u = linear::SymmetricSolver(
                       assembly::with_springs(model.stiffness, assembly::contact_springs(model.contacts)))
                       .solve(weight);
  CHECK((u - model.u0).cwiseAbs().maxCoeff() < 1e-12 * u.cwiseAbs().maxCoeff());
}

TEST_CASE("less friction: the portal's feet slip from the start, to their limit") {
  const Model model = build_model(read_scene(portal, {{"contacts.*.friction", "0.1"}, {"run.t_end", "0.1"}}));
  for (std::size_t k = 0; k < 2; ++k)
    CHECK(std::abs(model.contacts[k].initial_shear) ==
          doctest::Approx(0.1 * model.statics.reactions[k]).epsilon(1e-12));
  CHECK(model.statics.reactions[0] == doctest::Approx(model.statics.reactions[1]).epsilon(1e-10));
}

TEST_CASE("heat after weight: a hot beam slides out on one foot, in a reduced model too") {
  // A beam on two feet: the light end slides when EA alpha T (softened by kt) exceeds its limit.
  const std::string text = head + R"(
gravity = [0.0, -10.0]
[run]
t_end = 0.5
initial = "frictional"
[[run.stages]]
name = "weight"
loads = ["gravity"]
[[run.stages]]
name = "heat"
loads = ["temperature"]
[sections.s]
EA = 2e4
EI = 5e3
mass_per_length = 0.1
[nodes]
A = [0.0, 0.0]
B = [10.0, 0.0]
[[masses]]
node = "A"
mass = 0.5
[[members]]
nodes = ["A", "B"]
section = "s"
elements = 4
thermal_expansion = 1e-5
temperature = 100.0
[[contacts]]
name = "a"
node = "A"
law = "compliant"
normal = [0.0, 1.0]
normal_stiffness = 1e5
tangential_stiffness = 1e5
friction = 0.3
[[contacts]]
name = "b"
node = "B"
law = "compliant"
normal = [0.0, 1.0]
normal_stiffness = 1e5
tangential_stiffness = 1e5
friction = 0.3
)";
  // weights 10 and 5 kN, limits 3 and 1.5: force F = e / (10 / 2e4 + 2 / 1e5) until b slips at F = 1.5
  const double flexibility = 10.0 / 2e4 + 2.0 / 1e5, whole = 1e-5 * 100.0 * 10.0;
  for (const bool reduced : {false, true}) {
    const Model model = built(text + (reduced ? "[reduction]\ncutoff_omega = 300.0\n" : ""));
    REQUIRE(model.statics.events.size() == 1);
    CHECK(model.statics.events[0].stage == "heat");
    CHECK(model.statics.events[0].contact == 1);
    CHECK(model.statics.events[0].fraction == doctest::Approx(1.5 * flexibility / whole).epsilon(1e-9));
    CHECK(model.contacts[1].initial_shear == doctest::Approx(1.5).epsilon(1e-9));
    CHECK(model.contacts[0].initial_shear == doctest::Approx(-1.5).epsilon(1e-9));
    const Vector u = model.physical(model.u0);
    const double a = -1.5 / 1e5;
    CHECK(u[dof(model, "A.ux")] == doctest::Approx(a).epsilon(1e-8));
    CHECK(u[dof(model, "B.ux")] == doctest::Approx(a + whole - 1.5 * 10.0 / 2e4).epsilon(1e-8));
  }
}

TEST_CASE("a gap closes on the way, a fit comes apart: closed forms") {
  const auto text = [](const std::string& contact) {
    return head + "[run]\nt_end = 1.0\ninitial = \"frictional\"\n" + R"(
[nodes]
A = [0.0, 0.0]
[[masses]]
node = "A"
mass = 1.0
[[springs]]
node = "A"
direction = [1.0, 0.0]
stiffness = 30.0
[[supports]]
node = "A"
fix = ["uy"]
[[contacts]]
name = "stop"
node = "A"
law = "compliant"
normal = [-1.0, 0.0]
normal_stiffness = 20.0
)" + contact +
           push("push", 9.0);
  };
  const Model gap = built(text("gap = 0.1\n"));
  REQUIRE(gap.statics.events.size() == 1);
  CHECK(gap.statics.events[0].fraction == doctest::Approx(1.0 / 3.0).epsilon(1e-14));
  CHECK(gap.u0[0] == doctest::Approx((9.0 + 2.0) / 50.0).epsilon(1e-14));
  // 0.1 too long: u = -2 / 50 alone, then (9 - 2) / 50
  const Model fit = built(text("gap = -0.1\n"));
  CHECK(fit.u0[0] == doctest::Approx(7.0 / 50.0).epsilon(1e-14));
  CHECK(fit.statics.reactions[0] == doctest::Approx(20.0 * (0.1 + 0.14)).epsilon(1e-13));
  std::string rigid = text("gap = 0.1\n");
  rigid.replace(rigid.find("compliant"), 9, "rigid");
  rigid.erase(rigid.find("normal_stiffness = 20.0\n"), 24);
  const Model hard = built(rigid);
  CHECK(hard.u0[0] == doctest::Approx(0.1).epsilon(1e-14));
  CHECK(hard.statics.reactions[0] == doctest::Approx(6.0).epsilon(1e-13));
}

TEST_CASE("a symmetric portal stays symmetric where nothing says which of its feet slips") {
  // Weight 80 kN, then heat until both feet slip: T stays, so only how far they go apart is determined.
  for (const std::string law :
       {"law = \"rigid\"\n", "law = \"compliant\"\nnormal_stiffness = 1e7\ntangential_stiffness = 1e6\n"})
    for (const double friction : {0.3, 0.2}) {
      const Scene scene = parse_scene(heated_portal(law, friction), "test.toml");
      const Model model = build_model(scene);
      CAPTURE(law);
      const double left = model.u0[dof(model, "A.ux")], right = model.u0[dof(model, "D.ux")];
      CHECK(left < -1e-4);
      CHECK(right == doctest::Approx(-left).epsilon(1e-9));
      CHECK(model.u0[dof(model, "B.uy")] == doctest::Approx(model.u0[dof(model, "C.uy")]).epsilon(1e-9));
      // The legs carry f N at their feet and nothing else changes: the girder's heat and the bending.
      REQUIRE(model.statics.stages.size() == 5);
      const StageEnd& end = model.statics.stages.back();
      CHECK(end.states == std::vector<State>{State::slip_minus, State::slip_plus});
      CHECK(end.T[0] == doctest::Approx(-friction * 40.0).epsilon(1e-12));
      REQUIRE(model.warnings.size() >= 1);
      CHECK(model.warnings[0].find("horizontal motion while 'left' and 'right' are at the friction limit") !=
            std::string::npos);
      // Mirrored, with the contacts in another order, and turned by a right angle.
      Scene other = scene;
      for (Node& node : other.nodes) node.x = -node.x;
      std::swap(other.contacts[0], other.contacts[1]);
      const Model mirrored = build_model(other);
      CHECK(mirrored.u0[dof(mirrored, "A.ux")] == doctest::Approx(-left).epsilon(1e-9));
      Scene turned = scene;
      for (Node& node : turned.nodes) {
        std::swap(node.x, node.y);
        node.x = -node.x;
      }
      for (ContactSpec& c : turned.contacts) {
        c.normal->vector = {-1.0, 0.0};
        c.tangent->vector = {0.0, 1.0};
      }
      turned.loads[0].direction.vector = {1.0, 0.0};
      const Model upright = build_model(turned);
      CHECK(upright.u0[dof(upright, "A.uy")] == doctest::Approx(left).epsilon(1e-9));
      CHECK(upright.u0[dof(upright, "D.uy")] == doctest::Approx(right).epsilon(1e-9));
    }
  // Held by a spring on one side it is determined, however soft the spring, and nothing is said.
  const Model held = built(heated_portal("law = \"rigid\"\n", 0.3) +
                           "[[springs]]\nnode = \"B\"\ndirection = [1.0, 0.0]\nstiffness = 1.0\n");
  CHECK(held.statics.undetermined.empty());
}

TEST_CASE("what slips on by itself: flutter is told, what runs away is refused") {
  const auto pad = [](double damping) {
    return fmt::format(R"({0}[run]
t_end = 2.0
initial = "frictional"
[[run.stages]]
name = "weight"
loads = ["press"]
[[run.stages]]
name = "push"
loads = ["push"]
[matrices]
mass = [[2.0, 0.0], [0.0, 2.0]]
damping = [[{1}, 0.0], [0.0, {1}]]
stiffness = [[1000.0, 30.0], [30.0, 20.0]]
[[contacts]]
name = "pad"
law = "compliant"
normal = {{ d1 = 1.0 }}
tangent = {{ d0 = 1.0 }}
normal_stiffness = 1000.0
tangential_stiffness = 1000.0
friction = 0.4
[[loads]]
name = "press"
direction = {{ d1 = -1.0 }}
amplitude = 10.0
[[loads]]
name = "push"
direction = {{ d0 = 1.0 }}
amplitude = 20.0
)",
                       head, damping);
  };
  const Model flutters = built(pad(0.0));
  CHECK(flutters.statics.stages.back().states[0] == State::slip_plus);
  REQUIRE(flutters.warnings.size() == 1);
  CHECK(flutters.warnings[0].find(
            "if the slip of contact 'pad' continues after the slow start, an oscillation of") !=
        std::string::npos);
  CHECK(flutters.warnings[0].find("flutter") != std::string::npos);
  CHECK(built(pad(40.0)).warnings.empty());
}

TEST_CASE("after a slow start at its limits nothing slips by rounding, nor is energy lost") {
  const std::string text =
      heated_portal("law = \"compliant\"\nnormal_stiffness = 1e7\ntangential_stiffness = 1e6\n", 0.3);
  for (const std::string engine : {"friction-iteration", "newmark", "ida", "exact"}) {
    const Scene scene = parse_scene(text, "test.toml", {{"run.engine", engine}, {"run.dt", "1e-3"}});
    const Result result = simulate(build_model(scene), scene.run);
    CAPTURE(engine);
    for (const auto& event : result.events) CHECK(event.t == scene.run.t_end);
  }
  // 2.3 GN m are stored, and rounding of that is all that is exchanged.
  const Scene stiff = parse_scene(heated_portal("law = \"rigid\"\n", 0.9), "test.toml",
                                  {{"sections.s.EA", "1e9"}, {"members.2.temperature", "2000.0"}});
  const Result result = simulate(build_model(stiff), stiff.run);
  for (const std::string& warning : result.report.warnings)
    CHECK(warning.find("energy balance") == std::string::npos);
}

TEST_CASE("a stage of heat, base motion or preloads that are all zero is a stage in which nothing grows") {
  const std::string text =
      heated_portal("law = \"compliant\"\nnormal_stiffness = 1e7\ntangential_stiffness = 1e6\n", 0.3);
  const Model cold = build_model(parse_scene(text, "test.toml", {{"members.2.temperature", "0"}}));
  CHECK(!cold.statics.stages.empty());
  std::string weight = text;
  const std::string heat = "[[run.stages]]\nname = \"heat\"\nloads = [\"temperature\"]\nsteps = 4\n";
  weight.erase(weight.find(heat), heat.size());
  const Model alone = build_model(parse_scene(weight, "test.toml", {{"members.2.temperature", "0"}}));
  CHECK(cold.u0 == alone.u0);
  // Of what the scene does not have at all, a stage is still a mistake.
  for (const char* kind : {"base motion", "preload", "supports"}) {
    std::string other = text;
    other.replace(other.find("\"temperature\""), 13, fmt::format("\"{}\"", kind));
    CHECK(refusal(other).find(fmt::format("no load is called \"{}\"", kind)) != std::string::npos);
  }
}

TEST_CASE("what no frictional start can reach is refused by name") {
  // Both slip: nothing holds the pair.
  const std::string away = refusal(two_sliders(frictional, push("push", 5.0)));
  CHECK(away.find("no frictional start") != std::string::npos);
  CHECK(away.find("'ca', 'cb'") != std::string::npos);
  std::string falls = two_sliders(frictional, push("push", 1.2));
  falls.replace(falls.find("friction = 0.5"), 14, "friction = { static = 0.5, kinetic = 0.4 }");
  CHECK(refusal(falls).find("drops from static to kinetic") != std::string::npos);
  CHECK(refusal(
            two_sliders(frictional + "[[run.stages]]\nname = \"x\"\nloads = [\"psuh\"]\n", push("push", 1.0)))
            .find("did you mean \"push\"") != std::string::npos);
  CHECK(refusal(two_sliders(frictional + "[[run.stages]]\nname = \"x\"\nloads = [\"push\", \"push\"]\n",
                            push("push", 1.0)))
            .find("is already in an earlier stage") != std::string::npos);
  CHECK(refusal(two_sliders(frictional + "[[run.stages]]\nname = \"x\"\nloads = []\n", push("push", 1.0)))
            .find("no stage lists this load") != std::string::npos);
}

TEST_CASE(
    "what rests at its limit after a slow start rests to the end, and past loads that do not reach it") {
  // The start ends in slip: |T| = f |N| to the last digit. Nothing moves, so nothing happens, at t_end or when a load
  // elsewhere begins.
  const std::string scene = head + R"(gravity = [0.0, -9.81]
[run]
t_end = 1.0
dt = 1e-3
certify = false
initial = "frictional"
[nodes]
b = [0.0, 0.0]
far = [5.0, 0.0]
[[masses]]
node = "b"
mass = 1.7
[[masses]]
node = "far"
mass = 0.9
[[springs]]
node = "b"
direction = [1.0, 0.13]
stiffness = 41.3
[[springs]]
node = "far"
direction = [1.0, 0.0]
stiffness = 30.0
[[supports]]
node = "far"
fix = ["uy"]
[[contacts]]
name = "c"
node = "b"
law = "compliant"
normal = [0.03, 1.0]
normal_stiffness = 1.1e4
tangential_stiffness = 5.7e3
friction = 0.37
[[loads]]
node = "b"
direction = [1.0, 0.21]
amplitude = 15.3
[[loads]]
node = "far"
direction = [1.0, 0.0]
amplitude = 3.0
history = { type = "half_sine", start = 0.3, duration = 0.21 }
)";
  for (const char* engine : {"exact", "ida", "newmark"})
    for (const char* end : {"0.2", "0.733", "1.0"}) {
      CAPTURE(engine);
      CAPTURE(end);
      const Scene read = parse_scene(scene, "test.toml", {{"run.engine", engine}, {"run.t_end", end}});
      const Result result = simulate(build_model(read), read.run);
      CHECK(result.events.empty());
      CHECK(result.report.outcome.kind == Outcome::Kind::done);
    }
}

TEST_CASE("loads that pull off all that touches: contacts open at once and carry nothing") {
  // Without a contact: K u = P, and both gaps open at a constant rate from the beginning.
  const Model model = build_model(read_scene(SIGNORINI_TEST_DATA "/scenes/starts/opening.toml"));
  CHECK(model.statics.reactions == std::vector<double>{0.0, 0.0});
  for (const Contact& contact : model.contacts) CHECK(contact.gap_at(model.u0) > 0.0);
  const Vector miss = model.stiffness * model.u0 - static_load_of(model);
  CHECK(miss.cwiseAbs().maxCoeff() < 1e-12 * 29.0);
}

TEST_CASE("what slides while its load goes back opens where N and T come to zero together") {
  const Model model = build_model(read_scene(SIGNORINI_TEST_DATA "/scenes/starts/without_end.toml"));
  REQUIRE(!model.statics.events.empty());
  const StageEvent& last = model.statics.events.back();
  CHECK(last.stage == "two");
  CHECK(last.to == State::open);
  // It opens where the structure without it has no gap.
  CHECK(model.contacts[0].gap_at(model.u0) > 0.0);
  const Vector miss = model.stiffness * model.u0 - static_load_of(model);
  CHECK(miss.cwiseAbs().maxCoeff() < 1e-11 * 30.0);
}

TEST_CASE(
    "a reduced line whose shoes stand at their limits runs: rates of rounding tell no direction of slip") {
  // Static shapes have no mass. As long as beta K damped them, C v = P - K u - F left rounding of these forces over C as their
  // velocities, 1e-11 m/s; the witness took 1.2e-13 m/s of a shoe for a slip against its friction. Without the frozen forces'
  // part they had damping of either sign, and the run did not get on.
  const Scene scene = read_scene(SIGNORINI_TEST_DATA "/scenes/starts/reduced_rack.toml");
  for (const Engine engine : {Engine::exact, Engine::ida}) {
    Scene run = scene;
    run.run.engine = engine;
    const Result result = simulate(build_model(run), run.run);
    CHECK(result.report.outcome.reason == "");
    CHECK(result.report.law_checks.violations.empty());
  }
}

TEST_CASE("random starts keep the laws of contact all the way, turned and in another order the same") {
  int refused = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    const random_starts::Start start = random_starts::random_start(seed),
                               other = random_starts::turned_and_permuted(start, 0.7);
    const std::string text = random_starts::scene_of(start);
    const std::string why = refusal(text), other_why = refusal(random_starts::scene_of(other));
    CHECK((why == "none") == (other_why == "none"));
    if (why != "none" || other_why != "none") {
      // No rates keep the laws: small steps show that the structure would jump. Rare, as friction is high.
      CHECK(why.find("can neither hold nor slip in equilibrium") != std::string::npos);
      ++refused;
      continue;
    }
    const Model model = built(text), turned = built(random_starts::scene_of(other));
    const random_starts::Fault fault = random_starts::fault_of(start, model);
    INFO(fault.what);
    CHECK(fault.most < 1e-9);
    CHECK(random_starts::fault_of(other, turned).most < 1e-9);
    for (const Eigen::Index node : {0, 2}) {
      const random_starts::Pair u = random_starts::turned({model.u0[node], model.u0[node + 1]}, 0.7);
      CHECK(std::abs(turned.u0[node] - u[0]) < 1e-9);
      CHECK(std::abs(turned.u0[node + 1] - u[1]) < 1e-9);
    }
  }
  CHECK(refused <= 6);
}

TEST_SUITE_END();

}  // namespace signorini::tests::starts
