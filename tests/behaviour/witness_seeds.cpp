// Random scenes in which the witness once found something: the program was wrong, or a limit too small.
#include <doctest/doctest.h>

#include <vector>

#include "differential/generator.hpp"
#include "differential/witnessed.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::witness_seeds {
namespace {

Result run_scene(std::uint64_t seed, const std::vector<Override>& changes) {
  std::vector<Override> all = changes;
  all.push_back({"run.certify", "false"});
  const Scene scene = parse_scene(differential::draw_scene(seed), "seed.toml", all);
  Result result = simulate(build_model(scene), scene.run);
  CAPTURE(seed);
  CHECK(result.report.outcome.reason == "");
  CHECK(result.report.law_checks.violations.empty());
  return result;
}

const std::vector<Override> in_modes{{"run.engine", "exact"}, {"run.flow", "modal"}};

std::vector<Override> in_modes_to(const char* t_end) {
  std::vector<Override> changes = in_modes;
  changes.push_back({"run.t_end", t_end});
  return changes;
}

/// What the witness finds with the campaign's steps.
std::vector<differential::Alarm> steps_of(std::uint64_t seed) {
  CAPTURE(seed);
  const Scene scene = parse_scene(differential::draw_scene(seed), "seed.toml");
  std::vector<differential::Alarm> found;
  for (differential::Alarm& alarm : differential::before_the_witness(scene, 20000).alarms)
    if (alarm.way.find("newmark") == 0) found.push_back(std::move(alarm));
  return found;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/witness_seeds");

TEST_CASE(
    "late in a sequence of hits a dashpot's jump of N is below the rounding of kn u, and lets stick all the "
    "same") {
  const Result result = run_scene(620, in_modes_to("0.1424"));
  CHECK(result.events.size() > 400);
}

TEST_CASE("what rests on a surface that begins to move has the rounding of that motion") {
  for (const char* engine : {"exact", "ida", "newmark"})
    for (const std::uint64_t seed : {3067UL, 7425UL})
      CHECK(run_scene(seed, {{"run.engine", engine}, {"run.dt", "1e-4"}}).events.size() > 3);
}

TEST_CASE("a motion in modes that has just begun is a sum of amplitudes that still cancel") {
  CHECK(run_scene(173, in_modes_to("0.02")).events.size() == 0);
  CHECK(run_scene(245, in_modes_to("0.001")).events.size() > 0);
}

TEST_CASE(
    "what another contact's stop drags along has no guard that fell: no rate of it, and no uncertainty") {
  const Result result =
      run_scene(341, {{"run.engine", "newmark"}, {"run.dt", "0.032"}, {"run.t_end", "0.7"}});
  int dragged = 0;
  for (std::size_t i = 1; i < result.events.size(); ++i) {
    const Event &stop = result.events[i - 1], &slip = result.events[i];
    if (stop.type != EventType::stick || slip.type != EventType::slip || stop.t != slip.t) continue;
    ++dragged;
    CHECK(stop.t_uncertainty.has_value());
    CHECK(!slip.t_uncertainty.has_value());
    CHECK(!slip.guard_rate.has_value());
    CHECK(std::abs(slip.T) < 3.0 - 1.0);  // far from its limit of 0.3 * 10 before
  }
  CHECK(dragged == 1);
}

TEST_CASE("a corner of a wall and a floor that moves; a surface whose slip turns inside a step") {
  for (const char* engine : {"exact", "ida"}) {
    CAPTURE(engine);
    const Result corner = run_scene(930, {{"run.engine", engine}});
    // A table of velocities that passes zero in its second piece: the block leaves the wall there.
    const Event& last = corner.events.back();
    CHECK(last.type == EventType::separation);
    CHECK(last.t == doctest::Approx(0.3 + 0.3 * 0.2291 / 0.3437).epsilon(1e-9));
    run_scene(314, {{"run.engine", engine}});
    run_scene(722, {{"run.engine", engine}});
  }
}

TEST_CASE(
    "slow modes answer short ramps by terms 40,000 times the motion, which cancel: u is known to less") {
  for (const std::uint64_t seed : {3UL, 1595UL}) run_scene(seed, in_modes);
}

TEST_CASE("a slow pair of roots that is no free motion is left to the series, which lose no digits in it") {
  const Result result =
      run_scene(5058, in_modes);  // omega = 3e-3 rad/s over 2 s, of digits that K was rounded to
  const Result series = run_scene(5058, {{"run.engine", "exact"}, {"run.flow", "taylor"}});
  REQUIRE(result.events.size() == series.events.size());
  for (std::size_t i = 0; i < result.events.size(); ++i) {
    CAPTURE(i);
    CHECK(std::abs(result.events[i].t - series.events[i].t) < 1e-12);  // it was 1e-7
    CHECK(std::abs(result.events[i].T - series.events[i].T) < 1e-9);
  }
}

TEST_CASE(
    "where slides nearly depend on each other, rounding of the structure's forces is greater in theirs") {
  run_scene(685, in_modes);
}

TEST_CASE(
    "velocities that steps leave, by three rigid contacts of which two are nearly the same, and by "
    "dashpots") {
  for (const std::uint64_t seed : {1052UL, 1022UL}) CHECK(steps_of(seed).empty());
}

TEST_CASE(
    "a contact that opens while N hardly falls: zero is what a step's error hides, though the rate is "
    "small") {
  for (const std::uint64_t seed : {916UL, 1989UL, 5989UL}) CHECK(steps_of(seed).empty());
}

TEST_CASE("|N| of a slip drops by a hit that turns the body: T falls with it, and sticks") {
  const Result result = run_scene(1288, {{"run.engine", "exact"}});
  int stopped = 0;
  for (const Event& e : result.events)
    if (e.type == EventType::stick && e.N_after > e.N && std::abs(e.T - e.T_after) > 1e-3) {
      ++stopped;
      CHECK(std::abs(e.T_after) == doctest::Approx(0.676 * std::abs(e.N_after)).epsilon(1e-12));
    }
  CHECK(stopped == 2);
  CHECK(steps_of(5547).empty());
}

TEST_CASE("what rests is set to rest while a slider sticks: the slider's impulse against it is told, too") {
  CHECK(run_scene(5527, {{"run.engine", "ida"}, {"run.rtol", "1e-6"}, {"run.t_end", "0.13"}}).events.size() >
        0);
}

TEST_CASE("a slip that a hit stops, and that goes on a little before it turns, has its peak there") {
  run_scene(5387, {{"run.engine", "exact"}, {"run.flow", "taylor"}});
}

TEST_CASE("a block that starts at rest on a spring has been deep in it when it is at zero again") {
  run_scene(5372, {{"run.engine", "exact"}});
  CHECK(steps_of(5372).empty());
}

TEST_SUITE_END();

}  // namespace signorini::tests::witness_seeds
