// Bars, damping by ratios, and the new keys as the model sees them.
#include "model/element/line_elements.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "base/eigen_dense.hpp"
#include "unit/model/scenes.hpp"

using namespace signorini;
using namespace signorini::test;

namespace {

Scene bar(double dx, double dy, MassKind mass) {
  Scene s = empty_scene();
  s.sections = {{"rod", 8e4, 0.0, 0.6}};
  s.nodes = {{"L", 1.0, 2.0, {}}, {"R", 1.0 + dx, 2.0 + dy, {}}};
  Member m = member({"L", "R"}, "rod", {1});
  m.type = MemberType::bar;
  m.mass = mass;
  s.members = {m};
  s.supports = {support("L", true, true, false)};
  return s;
}

const std::string head =
    "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n"
    "[run]\nt_end = 1.0\n[nodes]\nA = [0.0, 0.0]\n[[masses]]\nnode = \"A\"\nmass = 2.0\n";

}  // namespace

TEST_SUITE("unit/model/element/bar") {
  TEST_CASE("a bar resists only its own stretching and carries its mass in both directions") {
    const double dx = 1.2, dy = -0.7, l = std::hypot(dx, dy), ea = 9e3, rho = 0.4;
    const element::BeamMatrix k = element::bar_stiffness(dx, dy, ea);
    Eigen::Matrix<double, 6, 1> x, y, turn, stretch;
    x << 1, 0, 0, 1, 0, 0;
    y << 0, 1, 0, 0, 1, 0;
    turn << 0, 0, 0, -dy, dx, 0;
    stretch << 0, 0, 0, dx / l, dy / l, 0;
    for (const auto& motion : {x, y, turn}) CHECK((k * motion).norm() <= 1e-12 * k.norm());
    CHECK(stretch.dot(k * stretch) == doctest::Approx(ea / l).epsilon(1e-14));
    for (const MassKind kind : {MassKind::consistent, MassKind::lumped}) {
      const element::BeamMatrix m = element::bar_mass(dx, dy, rho, kind);
      CHECK(x.dot(m * x) == doctest::Approx(rho * l).epsilon(1e-14));
      CHECK(y.dot(m * y) == doctest::Approx(rho * l).epsilon(1e-14));
    }
    // About one end the consistent mass has the inertia of a rod; the lumped one that of its end.
    CHECK(turn.dot(element::bar_mass(dx, dy, rho, MassKind::consistent) * turn) ==
          doctest::Approx(rho * l * l * l / 3.0));
    CHECK(turn.dot(element::bar_mass(dx, dy, rho, MassKind::lumped) * turn) ==
          doctest::Approx(rho * l * l * l / 2.0));
  }

  TEST_CASE("a bar fixed at one end swings along itself at sqrt(3 EA / rho) / L, lumped sqrt(2 ...)") {
    const double ea = 8e4, rho = 0.6;
    for (const double angle : {0.0, 0.6, 2.0}) {
      const double l = 2.5, dx = l * std::cos(angle), dy = l * std::sin(angle);
      for (const auto& [kind, factor] : {std::pair{MassKind::consistent, 3.0}, {MassKind::lumped, 2.0}}) {
        Scene s = bar(dx, dy, kind);
        // Across itself the bar is loose: hold that direction.
        Spring across;
        across.node = "R";
        across.direction = {-dy / l, dx / l};
        across.stiffness = 1e9;
        s.springs = {across};
        const Model model = build_model(s);
        CHECK(model.size() == 2);
        CHECK(dof(model, "R.rz") == -1);
        CHECK(model.omega1 == doctest::Approx(std::sqrt(factor * ea / rho) / l).epsilon(1e-10));
      }
    }
  }

  TEST_CASE("a truss of two bars deflects as statics say") {
    Scene s = empty_scene();
    s.sections = {{"rod", 5e3, 0.0, 0.0}};
    s.nodes = {{"L", -3.0, 0.0, {}}, {"T", 0.0, 4.0, {}}, {"R", 3.0, 0.0, {}}};
    Member m = member({"L", "T", "R"}, "rod", {1, 1});
    m.type = MemberType::bar;
    s.members = {m};
    s.supports = {support("L", true, true, false), support("R", true, true, false)};
    PointMass top;
    top.node = "T";
    top.mass = 2.0;
    s.masses = {top};
    s.gravity = {0.0, -10.0};
    s.initial.is_static = true;
    const Model model = build_model(s);
    // Each bar takes P / (2 sin a), sin a = 4/5, and shortens by S L / EA; the top sinks by that / sin a.
    const double force = 20.0 / (2.0 * 0.8), sunk = force * 5.0 / 5e3 / 0.8;
    CHECK(model.u0[dof(model, "T.uy")] == doctest::Approx(-sunk).epsilon(1e-12));
    CHECK(std::abs(model.u0[dof(model, "T.ux")]) < 1e-15);
  }

  TEST_CASE("a bar hinged to a beam leaves the beam's rotation alone") {
    Scene s = beam(4.0, 2, 1e6, 2e3, 0.1);
    s.sections.push_back({"rod", 1e5, 0.0, 0.1});
    s.nodes.push_back({"T", 4.0, 3.0, {}});
    Member rod = member({"R", "T"}, "rod", {1});
    rod.type = MemberType::bar;
    s.members.push_back(rod);
    s.supports = {support("L", true, true, true), support("T", true, true, false)};
    const Model model = build_model(s);
    CHECK(model.size() == 6);
    const int rz = dof(model, "R.rz");
    const Model alone = build_model([&] {
      Scene t = s;
      t.members.pop_back();
      t.nodes.pop_back();
      t.supports.pop_back();
      return t;
    }());
    CHECK(model.stiffness.coeff(rz, rz) == alone.stiffness.coeff(dof(alone, "R.rz"), dof(alone, "R.rz")));
    REQUIRE(model.drawing.size() == 3);
    CHECK(model.drawing[2].kind == DrawnElement::Kind::bar);
    CHECK(model.drawn_nodes[static_cast<std::size_t>(model.drawing[2].nodes[1])].name == "T");
    CHECK(model.drawn_nodes[2].held);
  }

  TEST_CASE("a bar in several elements, and a beam without EI, are refused") {
    Scene s = bar(2.0, 0.0, MassKind::consistent);
    s.members[0].elements = {2};
    CHECK(contains(refusal(s), "members.1.elements"));
    s = bar(2.0, 0.0, MassKind::consistent);
    s.members[0].type = MemberType::beam;
    CHECK(contains(refusal(s), "EI > 0"));
  }

  TEST_CASE("damping ratios hold exactly at the two frequencies") {
    const double pi = 3.14159265358979323846;
    for (const char* keys : {"ratios = [0.02, 0.05]\nfrequencies = [3.0, 8.0]\n",
                             "ratios = [0.05, 0.02]\nfrequencies = [8.0, 3.0]\n"}) {
      for (const auto& [f, ratio] : {std::pair{3.0, 0.02}, {8.0, 0.05}}) {
        const double omega = 2.0 * pi * f, stiffness = 2.0 * omega * omega;
        const Model model = build_model(parse_scene(
            head + "[[supports]]\nnode = \"A\"\nfix = [\"uy\"]\n[[springs]]\nnode = \"A\"\n" +
                "direction = [1.0, 0.0]\nstiffness = " + std::to_string(stiffness) + "\n[damping]\n" + keys,
            "test.toml"));
        CHECK(model.alpha >= 0.0);
        CHECK(model.beta >= 0.0);
        const double c = model.damping.coeff(0, 0);
        CHECK(c / (2.0 * 2.0 * omega) == doctest::Approx(ratio).epsilon(1e-9));
      }
    }
    // The extreme ratios leave one of the two: not a roundoff below zero.
    CHECK(parse_scene(head + "[damping]\nratios = [0.03, 0.1]\nfrequencies = [0.3, 1.0]\n", "t")
              .damping.alpha == 0.0);
    CHECK(
        parse_scene(head + "[damping]\nratios = [0.1, 0.03]\nfrequencies = [0.3, 1.0]\n", "t").damping.beta ==
        0.0);
  }
}
