#include "model/doubts.hpp"

#include <doctest/doctest.h>

#include <string>

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

TEST_SUITE_BEGIN("unit/model/doubts");

TEST_CASE("a load along what a support holds") {
  CHECK(says(doubts_of("load-on-held"), "load 1 acts only along what supports hold"));
  CHECK(doubts_of("load-on-held", {{"loads.1.amplitude", "0.0"}}).empty());
  CHECK(doubts_of("load-on-held", {{"loads.1.direction", "[1.0, 1.0]"}}).empty());
}

TEST_CASE("a body whose contacts lie on the wrong side falls away from them") {
  const auto fallen = doubts_of("wrongnormal");
  CHECK(says(fallen, "nothing stops the fall from contacts 'left' and 'right'"));
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
  CHECK(says(doubts_of("pump"), "damping alpha = 1.077 1/s drags free motions"));
  CHECK(says(doubts_of("pump"), "1/alpha = 0.9284 s"));
  CHECK(doubts_of("load-on-held").size() == 1);
}

TEST_CASE("friction above two") {
  CHECK(says(doubts_of("pump", {{"contacts.left.friction", "30.0"}}), "friction 30 at contact 'left'"));
  CHECK_FALSE(says(doubts_of("pump", {{"contacts.left.friction", "2.0"}}), "ratio of forces"));
}

TEST_CASE("an initial shear that a static start does not carry") {
  CHECK(says(doubts_of("shear0"), "initial_shear at contacts 'left' and 'right' does not fit"));
  CHECK_FALSE(says(doubts_of("shear0", {{"contacts.*.initial_shear", "0.0"}}), "initial_shear"));
}

TEST_CASE("doubts are the first warnings of a run") {
  const Scene scene = read_scene(SIGNORINI_TEST_DATA "/scenes/robust/load-on-held.toml");
  const Result result = simulate(build_model(scene), scene.run);
  REQUIRE(!result.report.warnings.empty());
  CHECK(result.report.warnings[0].find("load 1 acts only") == 0);
}

TEST_SUITE_END();
