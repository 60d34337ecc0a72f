// One problem, written in many ways: turned, mirrored, permuted, reversed, in other units. Its answer stays.
// The rest of them: signorini_differential --transformed.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>

#include "differential/generator.hpp"
#include "differential/metamorphic.hpp"

using namespace signorini;
using namespace signorini::differential;

namespace {

struct Sums {
  int scenes = 0, ways = 0;
  std::size_t events = 0;
};

void check_ways(const Scene& scene, const std::vector<Transformed>& ways, Engine engine, Sums& sums) {
  MetamorphicSettings settings;
  settings.engine = engine;
  settings.bounds.seconds = 1e6;  // no clock: a slow machine is no other verdict
  const Metamorphic judge(scene, settings);
  if (!judge.hindrance().empty()) return;
  ++sums.scenes;
  for (const Transformed& other : ways) {
    const Sameness found = judge.compare(other);
    CAPTURE(scene.title);
    CAPTURE(other.name);
    CAPTURE(found.what);
    CHECK(found.verdict == Sameness::Verdict::same);
    ++sums.ways;
    sums.events += found.events;
  }
}

void check_ways(const Scene& scene, std::uint64_t seed, Engine engine, Sums& sums) {
  check_ways(scene, transformations(scene, seed), engine, sums);
}

Scene model_scene(const std::string& name, std::vector<Override> changes = {}) {
  changes.push_back({"run.output_dt", "0.1"});
  return read_scene(std::string(SIGNORINI_MODELS) + "/" + name + ".toml", changes);
}

}  // namespace

TEST_SUITE("behaviour/metamorphic") {
  TEST_CASE("models, exact: the same events however they are written") {
    Sums sums;
    for (const char* name :
         {"belt", "coulomb-pad", "den-hartog", "lift-off", "matrices", "oscillator", "pipeline"})
      check_ways(model_scene(name), 1, Engine::exact, sums);
    // a hundred of its events; all of them: signorini_differential --angles 360 --scales 100
    check_ways(model_scene("rigid-frame", {{"run.t_end", "0.3"}}), 1, Engine::exact, sums);
    CHECK(sums.scenes == 8);
    CHECK(sums.ways > 150);
    CHECK(sums.events > 3000);
  }

  TEST_CASE("models, ida: within its tolerance") {
    Sums sums;
    for (const char* name : {"belt", "den-hartog", "oscillator"})
      check_ways(model_scene(name), 2, Engine::ida, sums);
    CHECK(sums.scenes == 3);
  }

  TEST_CASE(
      "newmark, around in 24 turns: a step that lifts off lands at rest, whatever rounding makes of that") {
    // From g = g' = g'' = 0 one step ends with g = h^2/4 g'' and g' = h/2 g'', so where it lands both vanish.
    Sums sums;
    const Scene scene = model_scene("rigid-frame", {{"run.dt", "1e-4"}, {"members.1.elements", "[2, 1, 2]"}});
    check_ways(scene, angles_and_scales(scene, 24, 0), Engine::newmark, sums);
    CHECK(sums.ways == 24);
    CHECK(sums.events == 24 * 222);
  }

  TEST_CASE("random scenes of all laws, exact") {
    Sums sums;
    std::vector<std::uint64_t> seeds{3, 19, 38};
    for (std::uint64_t seed = 101; seed <= 112; ++seed) seeds.push_back(seed);
    for (const std::uint64_t seed : seeds)
      check_ways(parse_scene(draw_scene(seed), "drawn.toml"), seed, Engine::exact, sums);
    CHECK(sums.scenes >= 10);
    CHECK(sums.events > 1000);
  }

  TEST_CASE("heat, moments, supports that move, stops and stages, written in other ways") {
    Sums sums;
    for (const std::uint64_t seed : {2U, 3U, 8U})
      check_ways(parse_scene(draw_loaded_scene(seed), "drawn.toml"), seed, Engine::exact, sums);
    check_ways(parse_scene(draw_loaded_scene(10), "drawn.toml"), 10, Engine::ida, sums);
    CHECK(sums.scenes == 4);
    CHECK(sums.events > 2000);
  }

  TEST_CASE("the judge sees what is not the same") {
    const Scene scene = model_scene("oscillator");
    const Metamorphic judge(scene, {});
    Transformed other = permuted(scene, 1);
    CHECK(judge.compare(other).verdict == Sameness::Verdict::same);
    other.scene.springs[0].stiffness *= 1.0 + 1e-10;
    CHECK(judge.compare(other).verdict == Sameness::Verdict::unlike);
    other.scene.springs[0].stiffness = -1.0;
    other.scene.masses[0].mass = -1.0;
    CHECK(judge.compare(other).verdict == Sameness::Verdict::refused);
  }

  TEST_CASE("what cannot be turned is left out") {
    CHECK_FALSE(turned(model_scene("oscillator"), 0.5));  // a support holds one translation
    CHECK_FALSE(turned(model_scene("matrices"), 0.5));
    CHECK_FALSE(in_units(model_scene("matrices"), {1.0, 2.0, 1.0}));
    CHECK_FALSE(reversed(model_scene("oscillator")));
    CHECK(turned(model_scene("rigid-frame"), 0.5));
    const std::optional<Transformed> quarter = turned(model_scene("oscillator"), 90.0);
    REQUIRE(quarter);  // which the scene can say: what held uy holds ux
    CHECK(quarter->scene.supports[0].ux == model_scene("oscillator").supports[0].uy);
    CHECK(quarter->scene.supports[0].uy == model_scene("oscillator").supports[0].ux);
  }
}
