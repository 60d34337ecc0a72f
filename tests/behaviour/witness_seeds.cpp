// Random scenes in which the witness once found something: the program was wrong, or a limit too small.
#include <doctest/doctest.h>

#include <vector>

#include "differential/generator.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::witness_seeds {
namespace {

Result run(std::uint64_t seed, const std::vector<Override>& changes) {
  std::vector<Override> all = changes;
  all.push_back({"run.certify", "false"});
  const Scene scene = parse_scene(differential::draw_scene(seed), "seed.toml", all);
  Result result = simulate(build_model(scene), scene.run);
  CAPTURE(seed);
  CHECK(result.report.outcome.reason == "");
  CHECK(result.report.witness.violations.empty());
  return result;
}

const std::vector<Override> in_modes{{"run.engine", "exact"}, {"run.flow", "modal"}};

std::vector<Override> in_modes_to(const char* t_end) {
  std::vector<Override> changes = in_modes;
  changes.push_back({"run.t_end", t_end});
  return changes;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/witness_seeds");

TEST_CASE(
    "late in a sequence of hits a dashpot's jump of N is below the rounding of kn u, and lets stick all the "
    "same") {
  const Result result = run(620, in_modes_to("0.1424"));
  CHECK(result.events.size() > 400);
}

TEST_CASE("a motion in modes that has just begun is a sum of amplitudes that still cancel") {
  CHECK(run(173, in_modes_to("0.02")).events.size() == 0);
  CHECK(run(245, in_modes_to("0.001")).events.size() > 0);
}

TEST_CASE(
    "what another contact's stop drags along has no guard that fell: no rate of it, and no uncertainty") {
  const Result result = run(341, {{"run.engine", "newmark"}, {"run.dt", "0.032"}, {"run.t_end", "0.7"}});
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
    const Result corner = run(930, {{"run.engine", engine}});
    // A table of velocities that passes zero in its second piece: the block leaves the wall there.
    const Event& last = corner.events.back();
    CHECK(last.type == EventType::separation);
    CHECK(last.t == doctest::Approx(0.3 + 0.3 * 0.2291 / 0.3437).epsilon(1e-9));
    run(314, {{"run.engine", engine}});
    run(722, {{"run.engine", engine}});
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::witness_seeds
