#include <doctest/doctest.h>

#include <cmath>

#include "unit/model/scenes.hpp"

using namespace signorini;
using namespace signorini::test;

TEST_SUITE("unit/model/build") {
  TEST_CASE("the pipeline: reactions, omega1, alpha, size, names") {
    const Model model = build_model(pipeline());
    CHECK(model.size() == 51);
    CHECK(model.statics.reactions[0] == doctest::Approx(58.86).epsilon(1e-9));
    CHECK(model.statics.reactions[1] == doctest::Approx(35.316).epsilon(1e-9));
    CHECK(model.omega1 == doctest::Approx(89.09).epsilon(1e-4));
    CHECK(model.alpha == doctest::Approx(17.8182).epsilon(1e-5));
    CHECK(model.omega_max > 4e4);
    CHECK(model.omega_max < 8e4);
    CHECK(model.statics.free_motions.at(0) == "horizontal motion held at contacts 'first' and 'second'");
    CHECK(model.scales.force == doctest::Approx(100.0));
    CHECK(model.scales.displacement > 1e-5);
    CHECK(model.scales.displacement < 1e-1);
    CHECK(model.scales.velocity == doctest::Approx(model.omega1 * model.scales.displacement));
    CHECK(model.scales.rotation == doctest::Approx(model.scales.displacement / std::hypot(18.0, 6.0)));
    CHECK(model.dofs[0].displacement == "A.ux");
    CHECK(model.dofs[2].velocity == "A.wz");
    CHECK(model.dofs[9].displacement == "A-B.1.ux");
    REQUIRE(model.columns.size() == 18);
    CHECK(model.columns[3].name == "A.vx");
    CHECK(model.columns[6].name == "B.ux");
    CHECK(model.drawing.size() == 16);
    const SparseMatrix rest = model.damping - model.alpha * model.mass;
    CHECK(rest.norm() <= 1e-14 * model.damping.norm());
    CHECK((model.contacts[0].tangent.terms == std::vector<std::pair<int, double>>{{0, 1.0}}));
  }

  TEST_CASE("omega1 holds contacts without friction too") {
    Scene s = pipeline();
    for (ContactSpec& c : s.contacts) c.friction = {0.0, 0.0};
    CHECK(build_model(s).alpha == doctest::Approx(17.8182).epsilon(1e-5));
  }

  TEST_CASE("the belt: one degree of freedom, a moving surface") {
    Scene s = empty_scene();
    s.nodes = {{"block", 0.0, 0.0, {}}};
    s.masses = {{"block", 1.0, 0.0, {}}};
    s.supports = {support("block", false, true, false)};
    Spring spring;
    spring.node = "block";
    spring.stiffness = 4.0;
    spring.damping = 0.3;
    s.springs = {spring};
    s.contacts = {slider("belt", Direction{"block", {1.0, 0.0}, {}, {}}, 1.0, 1.5)};
    s.contacts[0].surface_velocity.amplitude = 0.2;
    s.initial.components = {{"block", "ux", 0.5, {}}, {"block", "vx", -0.25, {}}, {"block", "uy", 0.0, {}}};
    const Model model = build_model(s);
    REQUIRE(model.size() == 1);
    CHECK(model.columns[1].name == "block.vx");
    CHECK(model.u0[0] == 0.5);
    CHECK(model.v0[0] == -0.25);
    CHECK(model.stiffness.coeff(0, 0) == 4.0);
    CHECK(model.damping.coeff(0, 0) == 0.3);
    CHECK(model.contacts[0].surface_motion.value(3.0) == doctest::Approx(0.6));
    CHECK(model.omega1 == 0.0);  // the slider without kt fixes all there is
    CHECK(model.scales.velocity == doctest::Approx(1.0));
    CHECK(model.scales.force == doctest::Approx(1.0));
    s.initial.components.push_back({"block", "uy", 0.1, {}});
    CHECK(contains(refusal(s), "run.initial.block.uy"));
  }

  TEST_CASE("springs between nodes, massless nodes between springs") {
    Scene s = empty_scene();
    s.nodes = {{"a", 0.0, 0.0, {}}, {"b", 1.0, 0.0, {}}};
    s.masses = {{"b", 2.0, 0.0, {}}};
    s.supports = {support("b", false, true, false)};
    Spring one, two;
    one.node = "a";
    one.stiffness = 10.0;
    two.node = "a";
    two.against = "b";
    two.stiffness = 15.0;
    s.springs = {one, two};
    const Model model = build_model(s);
    REQUIRE(model.size() == 2);
    CHECK(model.dofs[0].massless);
    CHECK(model.stiffness.coeff(0, 0) == 25.0);
    CHECK(model.stiffness.coeff(0, 1) == -15.0);
    // In series: 1 / (1/10 + 1/15) = 6
    CHECK(model.omega1 == doctest::Approx(std::sqrt(3.0)));
    CHECK(model.omega_max == doctest::Approx(std::sqrt(3.0)));
  }

  TEST_CASE("matrix scenes: names, massless rows, columns, sliders without kt fixed in omega1") {
    Scene s = matrices({{2, 0, 0}, {0, 0, 0}, {0, 0, 1}}, {{0.1, 0, 0}, {0, 0, 0}, {0, 0, 0}},
                       {{6, -2, 0}, {-2, 4, -1}, {0, -1, 3}});
    s.contacts = {slider("s", Direction{"", {}, {{"d2", 1.0}}, {}}, 1.0, 0.3)};
    s.initial.u = {1.0, 2.0, 3.0};
    const Model model = build_model(s);
    CHECK(model.dofs[1].displacement == "d1.u");
    CHECK(model.dofs[1].massless);
    CHECK_FALSE(model.dofs[2].massless);
    CHECK(model.columns[3].name == "d1.v");
    CHECK(model.omega1 == doctest::Approx(std::sqrt((6.0 - 2.0 * 2.0 / 4.0) / 2.0)));
    CHECK(model.u0[2] == 3.0);
    CHECK(model.v0.size() == 3);
    CHECK(model.damping.coeff(0, 0) == 0.1);
  }

  TEST_CASE("matrices that cannot be are refused") {
    const std::vector<std::vector<double>> zero{{0, 0}, {0, 0}}, one{{1, 0}, {0, 1}};
    CHECK(contains(refusal(matrices({{1, 1}, {1, 1}}, zero, one)), "positive definite"));
    CHECK(contains(refusal(matrices({{1, 0}, {0, -1}}, zero, one)), "diagonal"));
    CHECK(contains(refusal(matrices({{1, 0}, {0.5, 1}}, zero, one)), "symmetric"));
    CHECK(contains(refusal(matrices(one, zero, {{1, 0.5}, {0, 1}})), "symmetric"));
    CHECK(contains(refusal(matrices({{1, 0}, {0, 0}}, zero, {{1, 0}, {0, 0}})), "d1.u"));
    CHECK(contains(refusal(matrices(zero, zero, one)), "mass"));
    CHECK(contains(refusal(matrices({{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
                                    {{1, 0, 0}, {0, 5, -5}, {0, -5, 5}})),
                   "motion of d1.u (and 1 more)"));
    CHECK(refusal(matrices({{1, 0}, {0, 0}}, {{0, 0}, {0, 1}}, {{1, 0}, {0, 0}})).empty());
    Scene s = matrices(one, zero, one);
    s.initial.u = {1.0};
    CHECK(contains(refusal(s), "run.initial.u"));
  }

  TEST_CASE("contacts and loads that cannot act are refused by key") {
    Scene s = pipeline();
    s.contacts[0].tangential_stiffness.reset();
    CHECK(contains(refusal(s), "contacts.first.tangential_stiffness"));
    s = pipeline();
    s.supports = {support("A", false, true, false)};
    CHECK(contains(refusal(s), "contacts.first.normal"));
    s = pipeline();
    s.nodes.push_back({"C", 1.0, 1.0, {}});
    s.loads[0].direction.node = "C";
    CHECK(contains(refusal(s), "loads.1"));
    CHECK(contains(refusal(s), "node 'C' has no degree of freedom in x"));
    s = pipeline();
    s.contacts.push_back(slider("pad", Direction{"B", {1.0, 0.0}, {}, {}}, -1.0, 0.2));
    CHECK(contains(refusal(s), "contacts.pad.normal_force"));
  }

  TEST_CASE("a slope turns normal and tangent; both stay unit vectors") {
    Scene s = pipeline();
    s.initial.is_static = false;
    s.damping = {};
    s.contacts[0].normal->vector = {-0.3, 0.4};
    const Model model = build_model(s);
    const auto& n = model.contacts[0].normal.terms;
    const auto& t = model.contacts[0].tangent.terms;
    CHECK(n[0].second == doctest::Approx(-0.6));
    CHECK(n[1].second == doctest::Approx(0.8));
    CHECK(t[0].second == doctest::Approx(0.8));
    CHECK(t[1].second == doctest::Approx(0.6));
  }

  TEST_CASE("scales are positive and finite when a scene says next to nothing") {
    Scene s = matrices({{1}}, {{0}}, {{0}});
    Model model = build_model(s);
    for (double x : {model.scales.displacement, model.scales.velocity, model.scales.force,
                     model.scales.rotation, model.scales.angular_velocity}) {
      CHECK(std::isfinite(x));
      CHECK(x > 0.0);
    }
    s.initial.v = {3.0};
    model = build_model(s);
    CHECK(model.scales.velocity == doctest::Approx(3.0));
    CHECK(model.scales.displacement == doctest::Approx(3.0));
  }

  TEST_CASE("a state that the contacts cannot hold does not inflate the velocity scale") {
    Scene s = matrices({{1}}, {{0.02}}, {{4}});
    s.contacts = {slider("pad", Direction{"", {}, {{"d0", 1.0}}, {}}, 1.0, 0.4)};
    s.contacts[0].tangential_stiffness = 1e4;
    s.initial.u = {1.03};
    const Model model = build_model(s);
    CHECK(model.omega1 == doctest::Approx(std::sqrt(10004.0)));
    CHECK(model.scales.velocity == doctest::Approx(2.0 * 1.03));
  }

  TEST_CASE("scales follow the units: force 1000 times smaller numbers, length 1000 times larger") {
    Scene s = pipeline();
    const Scales metre = build_model(s).scales;
    // kN, t, m -> N, t, mm: force times 1000, length times 1000
    s.gravity[1] *= 1e3;
    s.sections[0].EA *= 1e3;
    s.sections[0].EI *= 1e9;
    s.sections[0].mass_per_length /= 1e3;
    for (Node& n : s.nodes) n.x *= 1e3, n.y *= 1e3;
    s.loads[0].amplitude *= 1e3;
    const Scales millimetre = build_model(s).scales;
    CHECK(millimetre.force == doctest::Approx(1e3 * metre.force));
    CHECK(millimetre.displacement == doctest::Approx(1e3 * metre.displacement).epsilon(1e-6));
    CHECK(millimetre.velocity == doctest::Approx(1e3 * metre.velocity).epsilon(1e-6));
    CHECK(millimetre.rotation == doctest::Approx(metre.rotation).epsilon(1e-6));
  }
}
