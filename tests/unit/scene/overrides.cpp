// --set path=value: what it reaches, and that every mistake in it is a wrong command line.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "scene/overrides.hpp"
#include "signorini/scene.hpp"

using namespace signorini;

namespace {

const std::string pipeline = SIGNORINI_MODELS "/pipeline.toml";

Scene with(const std::vector<Override>& overrides) { return read_scene(pipeline, overrides); }

void check_refused(const Override& change, const std::string& message) {
  INFO(change.path, "=", change.value);
  CHECK_THROWS_WITH_AS((void)with({change}), doctest::Contains(message.c_str()), UsageError);
}

}  // namespace

TEST_SUITE_BEGIN("unit/scene/overrides");

TEST_CASE("a part of gravity where the scene leaves it out: the other part is zero") {
  const std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n"
      "run = { t_end = 1.0 }\nnodes = { b = [0.0, 1.0] }\nmasses = [{ node = \"b\", mass = 2.0 }]\n";
  CHECK(parse_scene(text, "test.toml", {{"gravity.2", "-9.81"}}).gravity == std::array{0.0, -9.81});
  CHECK_THROWS_WITH_AS((void)parse_scene(text, "test.toml", {{"gravity.3", "1"}}),
                       doctest::Contains("gravity has 2 entries, but no \"3\""), UsageError);
}

TEST_CASE("overrides reach every kind of place") {
  CHECK(with({{"run.rtol", "1e-10"}}).run.rtol == 1e-10);
  CHECK(with({{"run.t_end", "2"}}).run.t_end == 2.0);
  CHECK(with({{"run.engine", "exact"}}).run.engine == Engine::exact);
  CHECK(with({{"title", "two words"}}).title == "two words");
  CHECK(with({{"run.initial", "{ A = { ux = 0.1 } }"}}).initial.components.size() == 1);
  CHECK(with({{"run.atol.force", "1e-3"}}).run.atol.force == 1e-3);
  CHECK(with({{"gravity.2", "-1.62"}}).gravity[1] == -1.62);
  CHECK(with({{"sections.pipe.EI", "1e6"}}).sections[0].EI == 1e6);
  CHECK(with({{"members.1.elements.2", "5"}}).members[0].elements == std::vector{4, 5});
  CHECK(with({{"loads.1.amplitude", "3"}}).loads[0].amplitude == 3.0);
  CHECK(with({{"loads.1.history.end", "0.2"}}).loads[0].history.end == 0.2);
  CHECK(with({{"reduction.cutoff_omega", "100"}}).reduction->cutoff_omega == 100.0);
  CHECK(with({{"reduction.cutoff_omega", "100"}, {"reduction.cutoff_frequency", "5"}})
            .reduction->cutoff_omega == doctest::Approx(10.0 * std::acos(-1.0)));
}

TEST_CASE("overrides choose contacts by name, by number, or all") {
  for (const char* path : {"contacts.second.friction", "contacts.2.friction"}) {
    const Scene scene = with({{path, "0.7"}});
    CHECK(scene.contacts[0].friction.static_ == 0.3);
    CHECK(scene.contacts[1].friction.static_ == 0.7);
  }
  const Scene all = with({{"contacts.*.friction", "0.9"}});
  CHECK(all.contacts[0].friction.kinetic == 0.9);
  CHECK(all.contacts[1].friction.kinetic == 0.9);
}

namespace {

/// Three contacts and two stops; `friction` of the stops.
std::string guided(const std::string& friction) {
  std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n"
      "run = { t_end = 1.0 }\nnodes = { a = [0.0, 0.0], b = [1.0, 0.0], c = [2.0, 0.0] }\n"
      "masses = [{ node = \"a\", mass = 2.0 }, { node = \"b\", mass = 2.0 }, { node = \"c\", mass = 2.0 }]\n";
  for (const char* node : {"a", "b", "c"})
    text += std::string("[[contacts]]\nname = \"under-") + node + "\"\nnode = \"" + node +
            "\"\nlaw = \"compliant\"\nnormal = [0.0, 1.0]\nnormal_stiffness = 1e3\n"
            "tangential_stiffness = 1e3\nfriction = 0.2\ngap = 0.1\n";
  for (const char* node : {"a", "c"})
    text += std::string("[[stops]]\nname = \"guide-") + node + "\"\nnode = \"" + node +
            "\"\nlaw = \"compliant\"\ndirection = [0.6, 0.8]\nnormal_stiffness = 1e3\n"
            "gaps = [0.02, 0.03]\n" +
            friction;
  return text;
}

}  // namespace

TEST_CASE("contacts.* are those of [[stops]], too") {
  const std::string text = guided("tangential_stiffness = 1e3\nfriction = 0.2\n");
  const Scene scene = parse_scene(text, "test.toml", {{"contacts.*.friction", "0.7"}});
  REQUIRE(scene.contacts.size() == 7);
  for (const ContactSpec& contact : scene.contacts) {
    CAPTURE(contact.name);
    CHECK(contact.friction.static_ == 0.7);
    CHECK(contact.friction.kinetic == 0.7);
  }
  const Scene one = parse_scene(text, "test.toml", {{"contacts.*.friction.kinetic", "0.1"}});
  for (const ContactSpec& contact : one.contacts) {
    CHECK(contact.friction.static_ == 0.2);
    CHECK(contact.friction.kinetic == 0.1);
  }
  for (const ContactSpec& contact : parse_scene(text, "test.toml", {{"contacts.*.gap", "0.5"}}).contacts)
    CHECK(contact.gap == 0.5);  // instead of two that differ
  CHECK_THROWS_WITH_AS((void)parse_scene(text, "test.toml", {{"contacts.*.frction", "0.7"}}),
                       doctest::Contains("--set contacts.*.frction=0.7"), UsageError);
  // A scene may have stops alone.
  std::string stops = text;
  for (std::size_t at; (at = stops.find("[[contacts]]")) != std::string::npos;)
    stops.erase(at, stops.find("[[", at + 2) - at);
  for (const ContactSpec& contact :
       parse_scene(stops, "test.toml", {{"contacts.*.normal_stiffness", "5e3"}}).contacts)
    CHECK(contact.normal_stiffness == 5e3);
}

TEST_CASE("a path with * says how many tables it met") {
  const toml::table root = toml::parse(guided("tangential_stiffness = 1e3\n"));
  CHECK(scene::count_matching_tables(root, "contacts.*.friction") ==
        "matches 3 of [[contacts]], 2 of [[stops]]");
  CHECK(scene::count_matching_tables(root, "stops.*.friction") == "matches 2 of [[stops]]");
  CHECK(scene::count_matching_tables(root, "masses.*.mass") == "matches 3 of [[masses]]");
  CHECK(scene::count_matching_tables(root, "contacts.under-a.friction").empty());
  CHECK(scene::count_matching_tables(root, "contacts.*.tangent") ==
        "matches 3 of [[contacts]], 0 of [[stops]] (2 cannot have this key with their present settings)");
  // A guide without a tangential stiffness stays without friction, and is told.
  const std::string smooth = guided("");
  CHECK(scene::count_matching_tables(toml::parse(smooth), "contacts.*.friction") ==
        "matches 3 of [[contacts]], 0 of [[stops]] (2 cannot have this key with their present settings)");
  const Scene scene = parse_scene(smooth, "test.toml", {{"contacts.*.friction", "0.7"}});
  CHECK(scene.contacts[0].friction.static_ == 0.7);
  CHECK_FALSE(scene.contacts[3].friction.any());
  // Two paths of one key overlap.
  const std::vector<std::string> places = scene::places_of(root, "contacts.*.friction");
  CHECK(places == std::vector<std::string>{"contacts.1.friction", "contacts.2.friction",
                                           "contacts.3.friction", "stops.1.friction", "stops.2.friction"});
}

TEST_CASE("friction as a number gives way to a table") {
  const Scene scene = with({{"contacts.first.friction.static", "0.4"}});
  CHECK(scene.contacts[0].friction.static_ == 0.4);
  CHECK(scene.contacts[0].friction.kinetic == 0.3);
  CHECK(with({{"contacts.*.friction", "{ static = 0.5 }"}}).contacts[1].friction.kinetic == 0.5);
}

TEST_CASE("an override replaces its alternative") {
  const Scene scene = with({{"damping.alpha", "2.0"}, {"run.output_times", "[0.5]"}});
  CHECK(scene.damping.alpha == 2.0);
  CHECK_FALSE(scene.damping.alpha_over_omega1);
  CHECK_FALSE(scene.run.output_dt);
}

TEST_CASE("overrides stand in run.toml") {
  const Scene scene = with({{"contacts.*.friction.static", "0.4"}, {"nodes.B", "[0.0, 7.0]"}});
  const Scene again = parse_scene(scene.resolved, "run.toml");
  CHECK(again.resolved == scene.resolved);
  CHECK(again.nodes[1].y == 7.0);
}

TEST_CASE("wrong overrides name themselves") {
  check_refused({"run.rtol", "abc"},
                "--set run.rtol=abc: run.rtol: found the string \"abc\", expected a number");
  check_refused({"run.rtol", "-1"}, "--set run.rtol=-1: run.rtol: found the number -1");
  check_refused({"run.rtoll", "1e-3"}, "run.rtoll: unknown key; did you mean \"rtol\"?");
  check_refused({"runn.rtol", "1e-3"}, "--set runn.rtol=1e-3: unknown key; did you mean \"run\"?");
  check_refused({"contacts.frist.friction", "1"},
                "contacts has 2 entries, but no \"frist\"; did you mean \"first\"?");
  check_refused({"contacts.3.friction", "1"}, "contacts has 2 entries, but no \"3\"");
  check_refused({"masses.*.mass", "1"}, "masses");
  check_refused({"run.t_end.x", "1"}, "run.t_end is the number 1.2, not a table");
  check_refused({"run.t_end", "1e-1O"}, "found the string \"1e-1O\", expected a number > 0");
  check_refused({"run.t_end", ""}, "the value is not TOML");
  check_refused({"run.t_end", "1 2"}, "the value is not TOML");
  check_refused({"run.t_end", "1\nrtol = 2"}, "the value is not TOML");
  check_refused({"run..t_end", "1"}, "expected path=value");
  check_refused({"", "1"}, "expected path=value");
  check_refused({"contacts.first.law", "rigid"},
                "contacts.first.normal_stiffness: has no meaning for a contact with law = \"rigid\"");
  check_refused({"schema", "2"}, "schema: found the number 2, expected 1");
  check_refused({"contacts", "3"}, "contacts: found the number 3, expected tables");
}

TEST_CASE("an override is called what the user called it") {
  check_refused({"run.rtol", "-1", "--vary run.rtol=-1:0:1"},
                "--vary run.rtol=-1:0:1: run.rtol: found the number -1");
  check_refused({"runn.rtol", "1e-3", "--fast"}, "--fast: unknown key; did you mean \"run\"?");
  check_refused({"run.engine", "exat", "--engines exat"}, "--engines exat: run.engine: found the string");
  check_refused({"contacts.first.friction.static", "0.2", "--sample x"}, "--sample x: ");
}

TEST_CASE("an override that breaks another line of the file is a wrong command line, too") {
  check_refused({"contacts.first.friction.static", "0.2"}, "--set contacts.first.friction.static=0.2: ");
  check_refused({"nodes.B", "[0.0, 0.0]"}, "--set nodes.B=[0.0, 0.0]: ");
  check_refused({"units.force", "MN"}, "--set units.force=MN");
  check_refused({"contacts.second.name", "first"}, "found \"first\" twice");
}

TEST_CASE("a wrong scene stays a wrong scene under a good override") {
  const std::string file = SIGNORINI_TEST_DATA "/scenes/bad/friction_negative.toml";
  CHECK_THROWS_AS((void)read_scene(file, {{"run.rtol", "1e-6"}}), SceneError);
  CHECK_NOTHROW((void)read_scene(file, {{"contacts.floor.friction", "0.3"}}));
}

TEST_CASE("overrides: bytes that are no text are a wrong command line, and are not printed") {
  check_refused({"title", "\xff\xfe"}, "--set title=??: found bytes that are not plain UTF-8 text");
  check_refused({"title", "a\x7f"}, "not plain UTF-8");
  check_refused({"title", "\x1b[31mred"}, "not plain UTF-8");
  check_refused({"contacts.\xc0\xaf.friction", "0.1"}, "not plain UTF-8");
  CHECK(with({{"title", "Br\u00fccke"}}).title == "Br\u00fccke");
}

TEST_SUITE_END();
