#include "engine/ida/step_newton.hpp"

#include <doctest/doctest.h>

#include "behaviour/one_mass.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/engine/ida/step_newton");

namespace {

Counters effort_of(const std::string& tangent) {
  const std::string matrices = "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[9.0, 0.0], [0.0, 400.0]]";
  const std::string contact =
      "law = \"compliant\"\nnormal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\nnormal_stiffness = 1e3\ngap = "
      "-0.05\n";
  return tests::run_text(tests::matrix_scene("t_end = 3.0\ninitial = { u = [0.0, 0.035], v = [1.0, 0.0] }",
                                             matrices, contact + tangent),
                         "ida", "1e-8")
      .report.counters;
}

}  // namespace

TEST_CASE("one iteration a step where equations are linear, more where friction depends on the slip rate") {
  const Counters linear = effort_of("tangential_stiffness = 1e3\nfriction = 0.3");
  REQUIRE(linear.steps > 100);
  CHECK(linear.residuals == linear.solves);
  CHECK(linear.solves >= linear.steps);
  CHECK(linear.solves <= linear.steps + linear.steps / 20);
  CHECK(linear.convergence_failures == 0);
  const Counters bent = effort_of("friction = { static = 0.4, kinetic = 0.1, stribeck_velocity = 0.3 }");
  REQUIRE(bent.steps > 100);
  CHECK(bent.residuals == bent.solves);
  CHECK(bent.solves > bent.steps + bent.steps / 20);
}
