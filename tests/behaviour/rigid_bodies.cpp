// Rigid bodies: closed forms of linear rocking, offsets, footings and rigid ends of beams.
//
//   ux_P = ux_C - rz (y_P - y_C),   uy_P = uy_C + rz (x_P - x_C)
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "behaviour/engines.hpp"
#include "behaviour/scene_parts.hpp"
#include "scene/outlines.hpp"
#include "signorini/certify.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::bodies {
namespace {

using namespace parts;

std::string body(const std::string& name, const std::string& centre, const std::string& nodes, double mass,
                 double inertia) {
  return fmt::format("[[rigid]]\nname = \"{}\"\ncentre = {}\nnodes = {}\nmass = {:.17g}\ninertia = {:.17g}\n",
                     name, centre, quoted(nodes), mass, inertia);
}

int place_of(const Model& model, const std::string& name) {
  const std::vector<Dof>& dofs = model.physical_dofs();
  for (std::size_t i = 0; i < dofs.size(); ++i)
    if (dofs[i].displacement == name) return static_cast<int>(i);
  FAIL("no degree of freedom " << name);
  return -1;
}

double start_of(const Model& model, const std::string& name) {
  return model.physical(model.u0, 0.0, 0)[place_of(model, name)];
}

Model built(const std::string& text, const std::vector<Override>& changes = {}) {
  return build_model(parse_scene(text, "test.toml", changes));
}

/// On feet at x = -b and b, its centre at the height h, thrown about the left one.
struct Rocking {
  double m = 2.3, b = 0.31, h = 1.17, g = 9.81, rate = 0.35;
  [[nodiscard]] double inertia() const { return m * (4.0 * b * b + 4.0 * h * h) / 12.0; }
  [[nodiscard]] double about_foot() const { return inertia() + m * (b * b + h * h); }
  [[nodiscard]] std::string scene(const std::string& engine) const {
    return head + fmt::format("gravity = [0.0, {:.17g}]\n", -g) +
           fmt::format("[run]\nt_end = 3.5\nengine = \"{}\"\ncertify = false\n", engine) +
           fmt::format("initial = {{ block = {{ vx = {:.17g}, vy = {:.17g}, wz = {:.17g} }} }}\n", -rate * h,
                       rate * b, rate) +
           fmt::format("[nodes]\nL = [{:.17g}, 0.0]\nR = [{:.17g}, 0.0]\n", -b, b) +
           body("block", fmt::format("[0.0, {:.17g}]", h), "L, R", m, inertia()) +
           "[[contacts]]\nname = \"foot\"\nnodes = [\"L\", \"R\"]\nlaw = \"rigid\"\nnormal = [0.0, "
           "1.0]\nfriction = "
           "2.0\n";
  }
};

/// Two springs upwards at x = -b and b, one sideways at the height of the centre, a force at the corner.
constexpr const char* footing_text = R"(
[run]
t_end = 1.0
initial = "static"
[nodes]
l = [-1.5, 0.0]
r = [1.5, 0.0]
top = [0.4, 0.8]
C = [0.0, 0.5]
side = [2.0, 0.5]
[[springs]]
node = "l"
direction = [0.0, 1.0]
stiffness = 900.0
[[springs]]
node = "r"
direction = [0.0, 1.0]
stiffness = 900.0
[[springs]]
node = "side"
direction = [1.0, 0.0]
stiffness = 250.0
[[loads]]
node = "top"
direction = [0.6, -0.8]
amplitude = 50.0
)";

}  // namespace

TEST_SUITE_BEGIN("behaviour/rigid_bodies");

TEST_CASE("a block rocks on two feet: ten impacts by the linear model's law") {
  const Rocking block;
  // About the standing foot I w' = -m g b; at an impact angular momentum about the foot that lands is kept.
  const double ratio =
      (block.inertia() + block.m * (block.h * block.h - block.b * block.b)) / block.about_foot();
  const double slowing = block.m * block.g * block.b / block.about_foot();
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Scene scene = parse_scene(block.scene(engine), "test.toml");
    const Result result = simulate(build_model(scene), scene.run);
    CHECK(result.report.outcome.reason == "");
    CHECK(result.report.law_checks.violations.empty());
    double t = 0.0, rate = block.rate;
    int impacts = 0;
    const double bound = engine == "exact" ? 1e-10 : 1e-6;
    for (const Event& event : result.events) {
      if (event.type != EventType::impact || !(event.vn < 0.0) || impacts == 10) continue;
      t += 2.0 * rate / slowing;
      CHECK(event.t == doctest::Approx(t).epsilon(bound));
      CHECK(event.contact == (impacts % 2 == 0 ? 1 : 0));
      CHECK(event.vn == doctest::Approx(-2.0 * block.b * rate).epsilon(bound));
      rate *= ratio;
      ++impacts;
    }
    CHECK(impacts == 10);
  }
}

TEST_CASE("ten seconds of rocking take a few steps for each impact, and the block comes to rest") {
  // The impacts follow in a geometric series: t = 2 rate / slowing / (1 - ratio) to the last.
  const Rocking block;
  const double ratio =
      (block.inertia() + block.m * (block.h * block.h - block.b * block.b)) / block.about_foot();
  const double slowing = block.m * block.g * block.b / block.about_foot();
  const double end = 2.0 * block.rate / slowing / (1.0 - ratio);
  REQUIRE(end < 10.0);
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Scene scene = parse_scene(block.scene(engine), "test.toml", {{"run.t_end", "10.0"}});
    const Result result = simulate(build_model(scene), scene.run);
    CHECK(result.report.outcome.reason == "");
    REQUIRE(!result.events.empty());
    CHECK(result.events.back().t == doctest::Approx(end).epsilon(1e-2));
    // A step or two for each event and nothing for rest: 10 s take milliseconds (benchmarks/README.md).
    CHECK(result.report.counters.steps <= 3 * static_cast<long>(result.events.size()));
  }
}

TEST_CASE("a mass at an offset: the parallel-axis theorem, wherever centre and support are") {
  const double m = 1.7, inertia = 0.23, k = 31.0, x = 0.6, y = -0.9;
  const double square = k / (inertia + m * (x * x + y * y));
  const std::string rest = head + run_table(1.0, 0.1) + "[nodes]\nA = [0.3, 0.2]\nB = [0.9, -0.7]\n" +
                           fixed("A", "ux, uy") +
                           fmt::format("[[springs]]\nnode = \"A\"\nrotation_stiffness = {}\n", k);
  for (const std::string& text :
       {rest + body("b", "\"A\"", "B", 0.0, 0.0) + point_mass("B", m, inertia),
        rest + body("b", "\"B\"", "A", m, inertia),
        rest + body("b", "[5.0, 7.0]", "A, B", 0.0, 0.0) + point_mass("B", m, inertia)}) {
    const Model model = built(text);
    CHECK(model.size() == 1);
    CHECK(model.omega1 == doctest::Approx(std::sqrt(square)).epsilon(1e-14));
  }
}

TEST_CASE("a free body's frequencies are those of its mass about its centre") {
  // A vertical spring at each end of an arm, the centre of mass not in the middle: a two by two problem.
  const double m = 3.0, inertia = 2.0, k = 40.0, a = 0.7, b = 1.6;
  const std::string text = head + run_table(1.0, 0.1) + "[nodes]\nL = [-0.7, 0.0]\nR = [1.6, 0.0]\n" +
                           body("arm", "[0.0, 0.0]", "L, R", m, inertia) + fixed("arm", "ux") +
                           spring("L", "[0.0, 1.0]", k) + spring("R", "[0.0, 1.0]", k);
  const double p = 2.0 * k / m, q = k * (a * a + b * b) / inertia, c = k * (b - a);
  const double mean = 0.5 * (p + q), half = std::sqrt(0.25 * (p - q) * (p - q) + c * c / (m * inertia));
  const Model model = built(text);
  CHECK(model.omega1 == doctest::Approx(std::sqrt(mean - half)).epsilon(1e-13));
  CHECK(model.omega_max == doctest::Approx(std::sqrt(mean + half)).epsilon(1e-9));
}

TEST_CASE("a footing under an eccentric force") {
  const Model model = built(head + footing_text + body("footing", "\"C\"", "l, r, top, side", 2.0, 1.0));
  const double down = 40.0 / 1800.0, moment = -0.4 * 40.0 - 0.3 * 30.0,
               turn = moment / (2.0 * 900.0 * 1.5 * 1.5);
  CHECK(start_of(model, "C.uy") == doctest::Approx(-down).epsilon(1e-13));
  CHECK(start_of(model, "C.rz") == doctest::Approx(turn).epsilon(1e-13));
  CHECK(start_of(model, "C.ux") == doctest::Approx(30.0 / 250.0).epsilon(1e-13));
  CHECK(start_of(model, "r.uy") == doctest::Approx(-down + 1.5 * turn).epsilon(1e-13));
  CHECK(start_of(model, "top.ux") == doctest::Approx(30.0 / 250.0 - 0.3 * turn).epsilon(1e-13));
  CHECK(start_of(model, "side.rz") == doctest::Approx(turn).epsilon(1e-13));
}

TEST_CASE("a cantilever with rigid ends") {
  const double L = 3.0, EI = 700.0, P = 5.0, a = 0.5, b = 0.8;
  const std::string text =
      head + run_table(1.0, 0.1, "static") + section(9e4, EI, 0.1) +
      "[nodes]\nwall = [0.0, 0.0]\nA = [0.5, 0.0]\nB = [3.5, 0.0]\ntip = [4.3, 0.0]\n" +
      fixed("wall", "ux, uy, rz") + member("A, B", "elements = 3\n") +
      body("root", "\"A\"", "wall", 0.0, 0.0) + body("end", "\"B\"", "tip", 0.4, 0.1) +
      "[[loads]]\nnode = \"tip\"\ndirection = [0.0, 1.0]\namplitude = 5.0\n"
      "[[output]]\nname = \"R\"\nkind = \"reaction\"\nat = \"wall\"\ndirection = [0.0, 1.0]\n"
      "[[output]]\nname = \"M0\"\nkind = \"reaction\"\nat = \"wall\"\nrotation = true\n"
      "[[output]]\nname = \"M\"\nkind = \"member_force\"\nat = [\"A\", \"B\"]\nquantity = \"M\"\n";
  const Model model = built(text);
  const double slope = P * L * L / (2.0 * EI) + P * b * L / EI;
  const double end = P * L * L * L / (3.0 * EI) + P * b * L * L / (2.0 * EI);
  CHECK(start_of(model, "B.uy") == doctest::Approx(end).epsilon(1e-11));
  CHECK(start_of(model, "tip.uy") == doctest::Approx(end + b * slope).epsilon(1e-11));
  const Scene scene = parse_scene(text, "test.toml", {{"run.engine", "exact"}});
  const Result result = simulate(model, scene.run);
  const std::vector<double>& values = result.responses.back().values;
  CHECK(values[0] == doctest::Approx(-P).epsilon(1e-10));
  CHECK(values[1] == doctest::Approx(-P * (L + a + b)).epsilon(1e-10));
  CHECK(std::abs(values[2]) == doctest::Approx(P * (L + b)).epsilon(1e-10));
}

TEST_CASE("reactions of supports at three nodes of a body, and their sum") {
  const std::string text =
      head + "gravity = [0.0, -10.0]\n" + run_table(1.0, 0.1, "static") +
      "[nodes]\nA = [0.0, 0.0]\nB = [4.0, 0.0]\nQ = [1.0, 2.0]\nk = [3.0, 1.0]\n" +
      body("block", "[2.0, 1.0]", "A, B, Q, k", 3.0, 1.0) + fixed("A", "uy") + fixed("B", "uy") +
      fixed("Q", "ux") + point_mass("k", 0.5) + "[[masses]]\nnode = \"free\"\nmass = 1.0\n" +
      fixed("free", "uy") + spring("free", "[1.0, 0.0]", 1.0) +
      "[[loads]]\nnode = \"k\"\ndirection = [1.0, 0.0]\namplitude = 6.0\n"
      "[[output]]\nname = \"A\"\nkind = \"reaction\"\nat = \"A\"\ndirection = [0.0, 1.0]\n"
      "[[output]]\nname = \"B\"\nkind = \"reaction\"\nat = \"B\"\ndirection = [0.0, 1.0]\n"
      "[[output]]\nname = \"Q\"\nkind = \"reaction\"\nat = \"Q\"\ndirection = [1.0, 0.0]\n";
  std::string scene_text = text;
  scene_text.replace(scene_text.find("k = [3.0"), 0, "free = [9.0, 0.0]\n");
  const Scene scene = parse_scene(scene_text, "test.toml", {{"run.engine", "exact"}});
  const Result result = simulate(build_model(scene), scene.run);
  CHECK(result.report.audit.reactions->value < 1e-11);
  const std::vector<double>& values = result.responses.back().values;
  // About A: 4 B - 2 * 30 - 3 * 5 - 6 * 1 + 6 * 2 = 0, with Q = -6 at the height 2.
  CHECK(values[1] == doctest::Approx((60.0 + 15.0 + 6.0 - 12.0) / 4.0).epsilon(1e-12));
  CHECK(values[0] + values[1] == doctest::Approx(35.0).epsilon(1e-12));
  CHECK(values[2] == doctest::Approx(-6.0).epsilon(1e-12));
}

TEST_CASE(
    "two supports that hold the same motion of a body leave its turn free; of a point they bear the load") {
  // L and R stand at one height: both hold ux, one uy, none rz.
  const Model model =
      built(head + run_table(1.0, 0.1) + "[nodes]\nL = [-1.0, 0.0]\nR = [1.5, 0.0]\n" +
            body("block", "[0.0, 2.0]", "L, R", 3.0, 1.0) + fixed("L, R", "ux") + fixed("L", "uy"));
  CHECK(model.size() == 1);
  // All nodes of a body at its centre: it has no size, and its support still bears it.
  const Scene scene = parse_scene(
      head + "gravity = [0.0, -10.0]\n" + run_table(1.0, 0.5, "static") + "[nodes]\nP = [1.0, 2.0]\n" +
          body("point", "[1.0, 2.0]", "P", 3.0, 1.0) + fixed("P", "uy") + spring("P", "[1.0, 0.0]", 4.0) +
          "[[springs]]\nnode = \"P\"\nrotation_stiffness = 2.0\n" +
          "[[output]]\nname = \"P\"\nkind = \"reaction\"\nat = \"P\"\ndirection = [0.0, 1.0]\n",
      "test.toml", {{"run.engine", "exact"}});
  CHECK(simulate(build_model(scene), scene.run).responses.back().values[0] ==
        doctest::Approx(30.0).epsilon(1e-12));
}

TEST_CASE("reactions of supports that bear a body together are refused") {
  const std::string text =
      head + run_table(1.0, 0.1) + "[nodes]\nA = [0.0, 0.0]\nB = [4.0, 0.0]\nC = [8.0, 0.0]\n" +
      body("beam", "\"B\"", "A, C", 3.0, 1.0) + fixed("A, B, C", "uy") + spring("A", "[1.0, 0.0]", 1.0) +
      "[[output]]\nname = \"A\"\nkind = \"reaction\"\nat = \"A\"\ndirection = [0.0, 1.0]\n";
  std::string why;
  try {
    (void)built(text);
  } catch (const SceneError& error) {
    why = error.what();
  }
  CHECK(why.find(
            "output.A.at: the reactions of the supports of rigid body 'beam' are statically indeterminate") !=
        std::string::npos);
}

TEST_CASE("a body is drawn as the hull of its nodes") {
  const auto lines = [](const std::string& nodes, const std::string& names) {
    const Scene scene = parse_scene(
        head + run_table(1.0, 0.1) + "[nodes]\n" + nodes + body("block", "[0.5, 0.5]", names, 1.0, 1.0),
        "test.toml");
    return scene::outline_of(scene, scene.rigid[0]);
  };
  const auto square = lines("A = [0.0, 0.0]\nB = [1.0, 1.0]\nC = [1.0, 0.0]\nD = [0.0, 1.0]\n", "A, B, C, D");
  REQUIRE(square.size() == 4);
  for (const auto& [from, to] : square) {
    CHECK(from != "block");
    CHECK(from != to);
    CHECK(from + to != "AB");
    CHECK(from + to != "BA");
  }
  CHECK(lines("A = [0.0, 0.0]\nB = [1.0, 1.0]\n", "A, B").size() == 1);
  CHECK(lines("A = [0.0, 0.0]\nB = [1.0, 0.0]\n", "A, B").size() == 3);
}

TEST_CASE("a support moves a body: its nodes follow, and what it gives is that of a rigid frame by hand") {
  // A bob on a spring at the tip of a rigid arm that turns: u'' = k/m (arm rz(t) - u).
  const std::string text =
      head + run_table(3.0, 0.25) + "[nodes]\nO = [0.0, 0.0]\ntip = [2.0, 0.0]\nbob = [2.0, 1.0]\n" +
      body("arm", "\"O\"", "tip", 1.0, 1.0) + fixed("O", "ux, uy") +
      fixed("O", "rz", "motion = { type = \"polynomial\", coefficients = [0.0, 0.0, 0.01] }\n") +
      point_mass("bob", 2.0) + fixed("bob", "ux") +
      "[[springs]]\nnode = \"bob\"\nagainst = \"tip\"\ndirection = [0.0, 1.0]\nstiffness = 18.0\n"
      "[[output]]\nname = \"tip\"\nkind = \"displacement\"\nat = \"tip\"\ndirection = [0.0, 1.0]\n";
  for (const std::string& engine : engines) {
    const Scene scene = parse_scene(text, "test.toml", {{"run.engine", engine}});
    const Model model = build_model(scene);
    const Result result = simulate(model, scene.run);
    for (std::size_t i = 0; i < result.rows.size(); ++i) {
      const auto& row = result.rows[i];
      // u = 0.02 (t^2 - 2/w^2 (1 - cos w t)), w = 3
      const double u = 0.02 * (row.t * row.t - 2.0 / 9.0 * (1.0 - std::cos(3.0 * row.t)));
      CHECK(row.u[place_of(model, "bob.uy")] == doctest::Approx(u).epsilon(1e-7));
      CHECK(row.u[place_of(model, "tip.uy")] == doctest::Approx(0.02 * row.t * row.t).epsilon(1e-14));
      CHECK(row.v[place_of(model, "tip.uy")] == doctest::Approx(0.04 * row.t).epsilon(1e-14));
      CHECK(result.responses[i].values[0] == doctest::Approx(0.02 * row.t * row.t).epsilon(1e-14));
    }
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::bodies
