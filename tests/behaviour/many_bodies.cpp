// Many bodies that nothing couples: each moves as if it were alone, whatever their number.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "behaviour/one_mass.hpp"
#include "engines.hpp"
#include "study/check/check.hpp"

using namespace signorini;

namespace {

/// Blocks of 1 kg, each on a contact of its own; they differ by their velocities and gaps.
std::string blocks(const std::string& law, int count, int first = 0) {
  std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n"
      "gravity = [0.0, -9.81]\n[run]\nt_end = 0.25\noutput_dt = 0.25\n[run.initial]\n";
  const auto name = [&](int i) { return std::to_string(first + i); };
  for (int i = 0; i < count; ++i)
    text += "b" + name(i) + " = { vx = " + std::to_string(0.1 + 0.001 * (first + i)) + " }\n";
  text += "[nodes]\n";
  for (int i = 0; i < count; ++i) text += "b" + name(i) + " = [" + name(i) + ".0, 0.0]\n";
  for (int i = 0; i < count; ++i) {
    text += "[[masses]]\nnode = \"b" + name(i) + "\"\nmass = 1.0\n[[contacts]]\nname = \"c" + name(i) +
            "\"\nnode = \"b" + name(i) + "\"\nfriction = 0.3\nlaw = \"" + law + "\"\n";
    const std::string gap = "gap = " + std::to_string(0.05 + 1e-3 * (first + i)) + "\n";
    if (law == "slider") text += "tangent = [1.0, 0.0]\nnormal_force = 9.81\n";
    if (law == "rigid") text += "normal = [0.0, 1.0]\nrestitution = 0.5\n" + gap;
    if (law == "compliant")
      text += "normal = [0.0, 1.0]\nnormal_stiffness = 1e5\ntangential_stiffness = 1e5\n" + gap;
  }
  return text;
}

const std::vector<std::string> laws{"slider", "rigid", "compliant"};

check::CheckReport checked(const std::string& text) {
  const Scene scene = parse_scene(text, "blocks.toml");
  return check::check(scene, build_model(scene));
}

std::vector<double> times_of(const Result& result, const Model& model, const std::string& contact) {
  std::vector<double> times;
  for (const Event& e : result.events)
    if (e.contact >= 0 && model.contacts[static_cast<std::size_t>(e.contact)].name == contact)
      times.push_back(e.t);
  return times;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/many_bodies");

TEST_CASE("free blocks of every law, by one and by hundreds: what holds them, their frequencies") {
  for (const std::string& law : laws)
    for (const int count : {1, 2, 123, 124, 260}) {
      CAPTURE(law);
      CAPTURE(count);
      const check::CheckReport report = checked(blocks(law, count));
      CHECK(report.contacts.size() == static_cast<std::size_t>(count));
      CHECK(report.free_motions.size() == static_cast<std::size_t>(2 * count));
      CHECK(report.open.free_motions == 2 * count);
      CHECK(report.open.modes.empty());
      REQUIRE(report.stuck.modes.size() ==
              (law == "compliant" ? std::min<std::size_t>(5, 2 * report.contacts.size()) : 0));
      for (const modes::NaturalMode& mode : report.stuck.modes)
        CHECK(mode.omega == doctest::Approx(std::sqrt(1e5)).epsilon(1e-9));
    }
}

TEST_CASE("a block among many moves as if it were alone") {
  for (const std::string& law : laws) {
    CAPTURE(law);
    const Scene many = parse_scene(blocks(law, 12), "blocks.toml");
    const Scene one = parse_scene(blocks(law, 1, 7), "blocks.toml");
    const Model model = build_model(many), alone = build_model(one);
    const auto together = times_of(simulate(model, many.run), model, "c7");
    const auto single = times_of(simulate(alone, one.run), alone, "c7");
    REQUIRE(!single.empty());
    REQUIRE(together.size() == single.size());
    for (std::size_t i = 0; i < single.size(); ++i)
      CHECK(together[i] == doctest::Approx(single[i]).epsilon(1e-9));
  }
}

TEST_CASE("an event of one body decides that body, whatever rests beside it") {
  // Contacts that rounds take together: with 300 bodies of which more and more have come to rest, an event
  // would take all of them.
  for (const int count : {30, 300}) {
    CAPTURE(count);
    std::string text = blocks("rigid", count);
    const std::string bounces = "restitution = 0.5";
    for (std::size_t at = text.find(bounces); at != std::string::npos; at = text.find(bounces))
      text.replace(at, bounces.size(), "restitution = 0");
    const Scene scene = parse_scene(text, "blocks.toml", {{"run.engine", "exact"}});
    long rounds = 0, together = 0;
    Result result;
    result.report = simulate(build_model(scene), scene.run, result, [&](const DecisionRound& round) {
      ++rounds;
      together += static_cast<long>(round.touching.size());
    });
    REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
    const auto events = static_cast<long>(result.events.size());
    CHECK(events >= count / 2);
    CHECK(together <= 4 * events);
    CHECK(rounds <= 6 * events);
  }
}

TEST_SUITE_END();

TEST_SUITE("slow/behaviour/many_bodies") {
  TEST_CASE("a thousand free blocks of every law can be checked and run") {
    for (const std::string& law : laws) {
      CAPTURE(law);
      std::string text = blocks(law, 1000);
      CHECK(checked(text).contacts.size() == 1000);
      text.replace(text.find("t_end = 0.25"), 12, "t_end = 0.02");
      const Scene scene = parse_scene(text, "blocks.toml");
      CHECK(simulate(build_model(scene), scene.run).report.outcome.kind == Outcome::Kind::done);
    }
  }
}
