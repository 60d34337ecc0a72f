// What a run says of itself: the energy balance, and what it cost.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

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

TEST_CASE(
    "at rest errors of energies are relative to the scales of the scene, not to the rounding that is "
    "exchanged") {
  for (const double degrees : {0.0, 20.0, 133.0}) {
    const double a = degrees * M_PI / 180.0, b = a - 15.0 * M_PI / 180.0;  // a slope of 15 degrees, turned
    const double c = std::cos(a), s = std::sin(a);
    const std::string text = fmt::format(
        "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\ngravity = "
        "[{:.17g}, {:.17g}]\n[run]\nt_end = 1.0\noutput_dt = 0.1\n[nodes]\nL = [{:.17g}, {:.17g}]\nR = "
        "[{:.17g}, "
        "{:.17g}]\n[[rigid]]\nname = \"box\"\ncentre = [0.0, 0.0]\nnodes = [\"L\", \"R\"]\nmass = "
        "500.0\ninertia "
        "= 50.0\n[[contacts]]\nname = \"foot\"\nnodes = [\"L\", \"R\"]\nlaw = \"rigid\"\nnormal = [{:.17g}, "
        "{:.17g}]\nfriction = 0.4\n",
        9.81 * std::sin(b), -9.81 * std::cos(b), -0.5 * c + 0.25 * s, -0.5 * s - 0.25 * c, 0.5 * c + 0.25 * s,
        0.5 * s - 0.25 * c, -s, c);
    for (const char* engine : {"ida", "exact"}) {
      CAPTURE(degrees);
      CAPTURE(engine);
      const Audit audit = run_text(text, engine).report.audit;
      CHECK(audit.product.value <= 1e-9 * audit.energy_reference());
      CHECK(audit.energy.value <= 1e-9 * audit.energy_reference());
    }
  }
  const Audit moving = run_text(swing, "exact").report.audit;
  CHECK(moving.energy_reference() == moving.energy_scale);
}

TEST_CASE("a series costs a solve for each of its levels") {
  const Counters& counters = run_text(swing, "exact").report.counters;
  CHECK(counters.solves >= 13 * counters.steps);
  CHECK(counters.solves <= 31 * counters.steps);
}

TEST_SUITE_END();
