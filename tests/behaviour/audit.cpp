// What a run says of itself: the energy balance, and what it cost.
#include <doctest/doctest.h>

#include <algorithm>

#include "behaviour/one_mass.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

/// Swings for two seconds, then rests: at the end nothing is exchanged any more.
const std::string swing =
    matrix_scene("t_end = 20.0\noutput_dt = 0.1\ninitial = { u = [1.0], v = [0.0] }",
                 "dofs = [\"x\"]\nmass = [[1.0]]\ndamping = [[0.2]]\nstiffness = [[100.0]]",
                 "law = \"slider\"\ntangent = { x = 1.0 }\nnormal_force = 10.0\nfriction = 0.3");

}  // namespace

TEST_SUITE_BEGIN("behaviour/audit");

TEST_CASE("an integrator's error shows in the energy balance, relative to the most that was exchanged") {
  const Result rough = run_text(swing, "ida", "1e-4"), sharp = run_text(swing, "exact");
  CHECK(rough.report.audit.energy.value > 1e-9 * rough.report.audit.energy_scale);
  CHECK(rough.report.audit.energy.value < 1e-2 * rough.report.audit.energy_scale);
  CHECK(sharp.report.audit.energy.value <= 1e-12 * sharp.report.audit.energy_scale);
  for (const Result* result : {&rough, &sharp}) {
    double most = 0.0;
    for (const auto& row : result->rows)
      most = std::max({most, row.energy.kinetic, row.energy.friction, row.energy.damping});
    CHECK(result->report.audit.energy_scale >= most);
    CHECK(result->report.audit.energy_scale <= 50.0);
  }
}

TEST_CASE("a series costs a solve for each of its levels") {
  const Counters& counters = run_text(swing, "exact").report.counters;
  CHECK(counters.solves >= 13 * counters.steps);
  CHECK(counters.solves <= 31 * counters.steps);
}

TEST_SUITE_END();
