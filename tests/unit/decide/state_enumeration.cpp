#include "decide/state_enumeration.hpp"

#include <doctest/doctest.h>

#include "behaviour/one_mass.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

/// A scene of one contact that just touches, at its beginning.
struct Touch {
  explicit Touch(const std::string& text)
      : model(build_model(parse_scene(text, "touch.toml"))),
        structure(model),
        systems(model, structure),
        jets(systems),
        enumeration(systems, jets),
        forcing(model, 0.0, motion::Side::after) {
    instant.u = model.u0;
    instant.v = model.v0;
    instant.states = {{State::open, 0.0}};
    known.touches = true;
    known.closing.zeros = 2;
  }
  [[nodiscard]] auto least_failing(const std::vector<decide::StateEnumeration::Choice>& choices) {
    return enumeration.best_combination(instant, forcing, {0}, choices, {known}, instant.states);
  }

  Model model;
  linear::SystemMatrices structure;
  motion::StateSystems systems;
  motion::JetMaker jets;
  decide::StateEnumeration enumeration;
  motion::Forcing forcing;
  decide::Instant instant;
  decide::KnownGuards known;
};

}  // namespace

TEST_SUITE_BEGIN("unit/decide/state_enumeration");

TEST_CASE("two combinations that go on otherwise are rivals, and are named") {
  // Painleve's rod: while it slips g'' = b + (W_nn - f W_nt) l with a negative factor, so with b > 0 it may
  // press or let go.
  Touch rod(matrix_scene(
      "t_end = 1.0\ninitial = { u = [0.0, 0.0], v = [1.0, 0.0] }",
      "mass = [[0.34847735667203295, 0.2532986927066816], [0.2532986927066816, 0.9015226433279672]]\n"
      "stiffness = [[0.0, 0.0], [0.0, 0.0]]",
      "law = \"rigid\"\nnormal = { d1 = -1.0 }\ntangent = { d0 = 1.0 }\nfriction = 4.0",
      "[[loads]]\ndirection = { d0 = 0.2532986927066816, d1 = 0.9015226433279672 }\namplitude = "
      "-10.0\n"));
  decide::Participant who{0};
  who.slipping = true;
  who.sign = 1;
  const std::vector<decide::StateEnumeration::Choice> choices{rod.enumeration.choice(who)};
  const auto best = rod.least_failing(choices);
  REQUIRE(best);
  CHECK(best->relative_violation == 0.0);
  REQUIRE(!best->alternative.empty());
  CHECK_FALSE(best->acceptable());
  CHECK(decide::several_motions(rod.model, choices, *best) ==
        "several motions continue from this instant: one with 'c' open; another with 'c' slip+");
}

TEST_CASE("between static and kinetic friction a block at rest sticks; slipping is no rival") {
  // 10 N on the floor and 4 N along it, between 3 and 5: slipping from rest would hold with 1 m/s^2.
  const auto asked = [](const char* friction) {
    Touch block(matrix_scene(
        "t_end = 1.0\ninitial = { u = [0.0, 0.0], v = [0.0, 0.0] }",
        "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[0.0, 0.0], [0.0, 0.0]]",
        std::string("law = \"rigid\"\nnormal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\nfriction = ") + friction,
        "[[loads]]\ndirection = { d0 = 4.0, d1 = -10.0 }\namplitude = 1.0\n"));
    block.known.sliding.zeros = 1;
    return block.least_failing({block.enumeration.choice(decide::Participant{0})});
  };
  const auto between = asked("{ static = 0.5, kinetic = 0.3 }");
  REQUIRE(between);
  CHECK(between->relative_violation == 0.0);
  CHECK(between->alternative.empty());
  CHECK(between->contact_states[0].state == State::stick);
  const auto above = asked("{ static = 0.35, kinetic = 0.3 }");
  REQUIRE(above);
  CHECK(above->alternative.empty());
  CHECK(above->contact_states[0].state == State::slip_plus);
}

TEST_CASE("the condition is that of the forces that contacts can bear") {
  // Two masses that move each other: a frictionless floor under one, a slider under the other.
  const Scene scene = parse_scene(
      matrix_scene(
          "t_end = 1.0\ninitial = { u = [0.0, 0.0], v = [0.0, 0.0] }",
          "mass = [[2.0, 1.0], [1.0, 2.0]]\nstiffness = [[1.0, 0.0], [0.0, 1.0]]",
          "law = \"rigid\"\nnormal = { d0 = 1.0 }\nrestitution = 0.5",
          "[[contacts]]\nname = \"s\"\nlaw = \"slider\"\ntangent = { d1 = 1.0 }\nnormal_force = 1.0\n"
          "friction = 0.3\n"),
      "two.toml");
  const Model model = build_model(scene);
  const linear::SystemMatrices structure(model);
  motion::StateSystems systems(model, structure);
  motion::JetMaker jets(systems);
  decide::StateEnumeration enumeration(systems, jets);
  const contact::ContactStates states{{State::open, 0.0}, {State::stick, 0.0}};
  // M^-1 = [[2, -1], [-1, 2]] / 3: scaled by its diagonal [[1, -1/2], [-1/2, 1]].
  CHECK(enumeration.condition({0, 1}, states) == doctest::Approx(3.0));
  CHECK(enumeration.condition({0}, states) == doctest::Approx(1.0));
  CHECK(enumeration.condition({1}, states) == doctest::Approx(1.0));
}

TEST_SUITE_END();
