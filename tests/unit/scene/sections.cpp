// Sections of shapes against the formulas of handbooks, units of factors, hangers and bends as they are read.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "scene/quantities.hpp"
#include "scene/units.hpp"
#include "signorini/error.hpp"
#include "unit/scene/equal.hpp"

namespace signorini::tests::sections {
namespace {

std::string scene_with(const std::string& section, const std::string& more = "") {
  return R"(schema = 1
units = { force = "kN", mass = "t", length = "m", time = "s" }
[run]
t_end = 1.0
[nodes]
A = [0.0, 0.0]
B = [1.0, 1.0]
)" + section +
         more;
}

Section section_of(const std::string& shape) {
  return parse_scene(scene_with("[sections.s]\n" + shape + "\n"), "test.toml").sections.at(0);
}

std::string refusal_of(const std::string& text) {
  try {
    (void)parse_scene(text, "test.toml");
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

void has(const std::string& text, const std::string& part) {
  CAPTURE(text);
  CHECK(text.find(part) != std::string::npos);
}

void is(double value, double expected) { CHECK(value == doctest::Approx(expected).epsilon(1e-13)); }

const std::string pipe =
    "pipe = { diameter = 0.3, wall = 0.01, E = 2e8, density = 8.0, content = 1.0, "
    "insulation = { thickness = 0.05, density = 0.1 } }";

}  // namespace

TEST_SUITE_BEGIN("unit/scene/sections");

TEST_CASE("a pipe with what is in it and around it") {
  const Section s = section_of(pipe);
  const double D = 0.3, d = 0.28, A = M_PI / 4.0 * (D * D - d * d);
  const double I = M_PI / 64.0 * (std::pow(D, 4) - std::pow(d, 4));
  is(s.EA, 2e8 * A);
  is(s.EI, 2e8 * I);
  is(s.area, A);
  is(s.modulus, M_PI / 32.0 * (std::pow(D, 4) - std::pow(d, 4)) / D);
  is(s.mass_per_length, 8.0 * A + M_PI / 4.0 * d * d + 0.1 * M_PI / 4.0 * (0.4 * 0.4 - D * D));
  is(s.pipe_radius, 0.145);
  is(s.pipe_wall, 0.01);
  is(section_of("pipe = { diameter = 0.3, wall = 0.01, E = 2e8, density = 8.0 }").mass_per_length, 8.0 * A);
}

TEST_CASE("a round rod, boxes, and an i both ways") {
  const Section round = section_of("round = { diameter = 0.2, E = 3.0, density = 5.0 }");
  is(round.EA, 3.0 * M_PI * 0.01);
  is(round.EI, 3.0 * M_PI * std::pow(0.2, 4) / 64.0);
  is(round.modulus, M_PI * std::pow(0.2, 3) / 32.0);
  is(round.mass_per_length, 5.0 * M_PI * 0.01);
  const Section solid = section_of("box = { width = 0.2, height = 0.5, E = 3.0, density = 5.0 }");
  is(solid.area, 0.1);
  is(solid.EI, 3.0 * 0.2 * 0.125 / 12.0);
  is(solid.modulus, 0.2 * 0.25 / 6.0);
  is(solid.mass_per_length, 0.5);
  const Section box = section_of("box = { width = 0.2, height = 0.5, wall = 0.02, E = 3.0, density = 5.0 }");
  is(box.area, 0.1 - 0.16 * 0.46);
  is(box.EI, 3.0 * (0.2 * 0.125 - 0.16 * std::pow(0.46, 3)) / 12.0);
  is(box.modulus, (0.2 * 0.125 - 0.16 * std::pow(0.46, 3)) / 12.0 / 0.25);
  const std::string i = "i = { width = 0.3, height = 0.4, web = 0.01, flange = 0.02, E = 2.0, density = 1.0";
  const Section strong = section_of(i + " }"), weak = section_of(i + ", axis = \"weak\" }");
  is(strong.area, 2.0 * 0.3 * 0.02 + 0.36 * 0.01);
  is(weak.area, strong.area);
  // Steiner: two flanges off the middle and a web
  const double I =
      0.01 * std::pow(0.36, 3) / 12.0 + 2.0 * (0.3 * std::pow(0.02, 3) / 12.0 + 0.3 * 0.02 * 0.19 * 0.19);
  is(strong.EI, 2.0 * I);
  is(strong.modulus, I / 0.2);
  const double J = 2.0 * 0.02 * 0.027 / 12.0 + 0.36 * 1e-6 / 12.0;
  is(weak.EI, 2.0 * J);
  is(weak.modulus, J / 0.15);
}

TEST_CASE("what is wrong with a section is said") {
  const auto refused = [](const std::string& shape) {
    return refusal_of(scene_with("[sections.s]\n" + shape + "\n"));
  };
  has(refused("EA = 1.0\n" + pipe), "sections.s.EA: follows from pipe");
  has(refused("mass_per_length = 1.0\n" + pipe), "sections.s.mass_per_length: follows from pipe");
  has(refused(pipe + "\nround = { diameter = 1.0, E = 1.0, density = 1.0 }"), "cannot be combined with pipe");
  has(refused("EI = 1.0"), "sections.s.EA: missing, expected a number > 0");
  has(refused("EA = 1.0"), "sections.s.mass_per_length: missing");
  has(refused("pipe = { diameter = 0.3, wall = 0.15, E = 1.0, density = 1.0 }"),
      "sections.s.pipe.wall: found 0.15, expected less than half of the diameter 0.3");
  has(refused("pipe = { diameter = 0.3, E = 1.0, density = 1.0 }"), "sections.s.pipe.wall: missing");
  has(refused("pipe = { diameter = 0.3, wall = 0.01, E = 1.0, density = 1.0, contents = 1.0 }"), "content");
  CHECK(refused("box = { width = 0.1, height = 0.3, wall = 0.0499, E = 1.0, density = 1.0 }") == "");
  has(refused("box = { width = 0.1, height = 0.3, wall = 0.05, E = 1.0, density = 1.0 }"),
      "expected less than half of the width 0.1");
  has(refused("i = { width = 0.1, height = 0.3, web = 0.2, flange = 0.01, E = 1.0, density = 1.0 }"),
      "expected at most the width 0.1");
  has(refused("i = { width = 0.1, height = 0.3, web = 0.01, flange = 0.15, E = 1.0, density = 1.0 }"),
      "expected less than half of the height 0.3");
}

TEST_CASE("bends: the printed formula, given factors, and what cannot be") {
  const auto member = [](const std::string& bend, const std::string& more = "") {
    return scene_with("[sections.s]\n" + pipe + "\n[sections.t]\nEA = 1.0\nEI = 1.0\nmass_per_length = 1.0\n",
                      "[[members]]\nnodes = [\"A\", \"B\"]\nbend = " + bend + "\n" + more);
  };
  const auto bend_of = [&](const std::string& bend, const std::string& section) {
    return *parse_scene(member(bend, "section = \"" + section + "\""), "test.toml").members.at(0).bend;
  };
  const double h = 0.01 * 1.2 / (0.145 * 0.145);
  const Bend b = bend_of("{ radius = -1.2 }", "s");
  is(b.flexibility, 1.65 / h);
  is(b.intensification, 0.9 / std::pow(h, 2.0 / 3.0));
  is(b.radius, -1.2);
  const Bend wide = bend_of("{ radius = 200.0 }", "s");
  CHECK(wide.flexibility == 1.0);
  CHECK(wide.intensification == 1.0);
  const Bend given = bend_of("{ radius = 1.2, flexibility = 3.0, sif = 1.5 }", "s");
  CHECK(given.flexibility == 3.0);
  CHECK(given.intensification == 1.5);
  const Bend arch = bend_of("{ radius = 1.2 }", "t");
  CHECK(arch.flexibility == 1.0);
  CHECK(arch.intensification == 1.0);
  CHECK(
      parse_scene(member("{ radius = 1.2 }", "section = \"s\""), "test.toml").members.at(0).elements.at(0) ==
      8);
  has(refusal_of(member("{ radius = 0.7 }", "section = \"s\"")),
      "members.1.bend.radius: found 0.7, expected at least half the distance between \"A\" and \"B\", "
      "0.707106781");
  has(refusal_of(member("{ radius = 0.0 }", "section = \"s\"")), "found 0, expected at least half");
  has(refusal_of(member("{ radius = 1.2 }", "section = \"s\"\nelements = 1")),
      "found 1, expected at least 2 on an arc");
  has(refusal_of(member("{ radius = 1.2 }", "section = \"s\"\ntype = \"bar\"")), "has no meaning for a bar");
}

TEST_CASE("hangers: two of cold load, travel and stiffness") {
  const auto spring = [](const std::string& keys) {
    return scene_with("", "[[springs]]\nnode = \"A\"\ndirection = [0.0, -2.0]\n" + keys + "\n");
  };
  const auto read = [&](const std::string& keys) {
    return parse_scene(spring(keys), "test.toml").springs.at(0);
  };
  for (const char* keys : {"hanger = { hot = 12.0, cold = 14.0, travel = 0.02 }",
                           "stiffness = 100.0\nhanger = { hot = 12.0, cold = 14.0 }",
                           "stiffness = 100.0\nhanger = { hot = 12.0, travel = 0.02 }"}) {
    CAPTURE(keys);
    const Spring s = read(keys);
    is(s.preload, 14.0);
    is(s.stiffness, 100.0);
    is(*s.hot_load, 12.0);
    const Scene scene = parse_scene(spring(keys), "test.toml");
    CHECK(testing::dump(parse_scene(scene.resolved, "test.toml")) == testing::dump(scene));
  }
  is(read("preload = -3.0").preload, -3.0);
  CHECK(!read("preload = -3.0").hot_load);
  has(refusal_of(spring("hanger = { hot = 12.0, cold = 14.0 }")), "found one of cold, travel");
  has(refusal_of(spring("stiffness = 1.0\nhanger = { hot = 12.0, cold = 14.0, travel = 2.0 }")),
      "found all three of cold, travel");
  has(refusal_of(spring("hanger = { hot = 12.0, cold = 10.0, travel = 0.02 }")),
      "the stiffness would be -100");
  has(refusal_of(spring("preload = 1.0\nhanger = { hot = 12.0, cold = 14.0, travel = 0.1 }")),
      "cannot be combined with hanger");
  // A --set that contradicts the file is a wrong --set, whichever key the message would stand at in a file.
  for (const auto& [keys, change, message] :
       {std::tuple{"hanger = { hot = 12.0, cold = 14.0, travel = 0.02 }",
                   Override{"springs.1.hanger.hot", "15.0"}, "the stiffness would be -50"},
        {"hanger = { hot = 12.0, cold = 14.0, travel = 0.02 }", Override{"springs.1.stiffness", "3.0"},
         "found all three of cold, travel"},
        {"hanger = { hot = 12.0, cold = 14.0, travel = 0.02 }", Override{"springs.1.preload", "3.0"},
         "cannot be combined with hanger"},
        {"preload = 3.0", Override{"springs.1.hanger", "{ hot = 12.0, cold = 14.0, travel = 0.02 }"},
         "cannot be combined with hanger"},
        {"stiffness = 10.0\nhanger = { hot = 12.0, travel = -1.0 }", Override{"springs.1.stiffness", "13.0"},
         "hot + stiffness * travel, would be -1"}}) {
    CAPTURE(keys);
    CAPTURE(change.path);
    CHECK_THROWS_WITH_AS((void)parse_scene(spring(keys), "test.toml", {change}), doctest::Contains(message),
                         UsageError);
    CHECK_THROWS_WITH_AS((void)parse_scene(spring(keys), "test.toml", {change}),
                         doctest::Contains(("--set " + change.path).c_str()), UsageError);
  }
  has(refusal_of(scene_with("", "[[springs]]\nnode = \"A\"\nrotation_stiffness = 1.0\npreload = 2.0\n")),
      "needs a direction in the same table");
}

TEST_CASE("sections, bends, hangers and factors read back as they were, and change with the units") {
  const std::string text = scene_with(
      "[sections.s]\n" + pipe +
          "\n[sections.b]\nbox = { width = 0.2, height = 0.5, wall = 0.02, E = 3.0, density = 5.0 }\n" +
          "[sections.c]\ni = { width = 0.3, height = 0.4, web = 0.01, flange = 0.02, E = 2.0, density = 1.0, "
          "axis = "
          "\"weak\" }\n[sections.r]\nround = { diameter = 0.2, E = 3.0, density = 5.0 }\n" +
          "[sections.g]\nEA = 1.0\nEI = 2.0\nmass_per_length = 3.0\narea = 4.0\nmodulus = 5.0\n",
      R"([[members]]
nodes = ["A", "B"]
section = "s"
bend = { radius = 1.5 }
[[springs]]
node = "B"
direction = [1.0, 2.0]
preload = 3.0
[[output]]
name = "M"
kind = "member_force"
at = ["A", "B"]
quantity = "M"
[[output]]
name = "sum"
kind = "combination"
terms = { M = { factor = 8.0, unit = "1/m^3" } }
[[output]]
name = "e"
kind = "envelope"
nodes = ["A", "B"]
quantity = "stress"
fibre = "left"
sif = 1.25
[[output]]
name = "s"
kind = "stress"
at = ["A", "B"]
station = 0.25
)");
  const Scene scene = parse_scene(text, "test.toml");
  CHECK(testing::dump(parse_scene(scene.resolved, "test.toml")) == testing::dump(scene));
  CHECK(parse_scene(scene.resolved, "test.toml").resolved == scene.resolved);
  const Scene other = scene::rescaled(scene, {4.0, 2.0, 1.0});
  CHECK(other.sections[0].area == 4.0 * scene.sections[0].area);
  CHECK(other.sections[0].modulus == 8.0 * scene.sections[0].modulus);
  CHECK(other.sections[0].pipe_radius == 2.0 * scene.sections[0].pipe_radius);
  CHECK(other.members[0].bend->radius == 3.0);
  CHECK(other.members[0].bend->flexibility == scene.members[0].bend->flexibility);
  CHECK(other.springs[0].preload == 12.0);
  CHECK(other.outputs[1].terms[0].factor == 1.0);
}

TEST_CASE("units as texts") {
  const Units names{"kN", "t", "m", "s"};
  const auto is_unit = [&](const char* text, int force, int length, int time) {
    CAPTURE(text);
    const auto unit = scene::unit_of_text(text, names);
    REQUIRE(unit);
    CHECK(unit->force == force);
    CHECK(unit->length == length);
    CHECK(unit->time == time);
  };
  is_unit("1/m^2", 0, -2, 0);
  is_unit("kN m/s", 1, 1, -1);
  is_unit("kN*m", 1, 1, 0);
  is_unit("s^2/t", -1, 1, 0);
  is_unit("1", 0, 0, 0);
  is_unit("m^3/kN s", -1, 3, -1);
  for (const char* wrong : {"", "/m", "mm", "m^", "m^0", "m^2.5", "1/", "m/s/s", "kN--m"}) {
    CAPTURE(wrong);
    CHECK(!scene::unit_of_text(wrong, names));
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::sections
