// Scenes of an unfriendly size, through ida.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

Result run(const std::string& name, const std::string& engine, const std::vector<Override>& more = {}) {
  std::vector<Override> changes = more;
  changes.push_back({"run.engine", engine});
  const Scene scene =
      read_scene(std::string(SIGNORINI_TEST_DATA) + "/scenes/awkward/" + name + ".toml", changes);
  return simulate(build_model(scene), scene.run);
}

}  // namespace

TEST_SUITE("behaviour/awkward") {
  TEST_CASE("a belt in micrometres: friction says how far it goes") {
    const Result result = run("belt-micrometre", "ida", {{"run.rtol", "1e-8"}});
    std::vector<double> slips;
    for (const Event& event : result.events)
      if (event.type == EventType::slip) slips.push_back(event.t);
    REQUIRE(slips.size() >= 3);
    // It slips back until sin t = 0.2, then rides with the belt until the spring holds the static limit.
    const double first = std::asin(0.2) + (0.5 + std::sqrt(0.96)) / 0.2;
    CHECK(std::abs(slips[0] - first) < 1e-6);
    const double period = std::numbers::pi + 2.0 * std::atan(0.4) + 5.0;
    for (std::size_t i = 1; i < slips.size(); ++i) CHECK(std::abs(slips[i] - slips[i - 1] - period) < 1e-6);
  }

  TEST_CASE(
      "an oscillator that sticks at its limit, on its own spring: it touches the limit and does not slip") {
    for (const char* rtol : {"1e-9", "1e-10", "1e-11", "1e-12"}) {
      CAPTURE(rtol);
      const Scene scene = read_scene(std::string(SIGNORINI_MODELS) + "/oscillator.toml",
                                     {{"run.engine", "ida"}, {"run.rtol", rtol}});
      CHECK(simulate(build_model(scene), scene.run).events.size() == 12);
    }
  }
}
