#include "engine/ida/step_newton.hpp"

#include <doctest/doctest.h>

#include "behaviour/one_mass.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/engine/ida/step_newton");

namespace {

/// A mass on a spring that a load presses onto a contact, along which it slides.
Counters effort_of(const std::string& contact) {
  const std::string matrices = "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[9.0, 0.0], [0.0, 400.0]]";
  return tests::run_text(
             tests::matrix_scene("t_end = 3.0\ninitial = { u = [0.0, 0.0], v = [1.0, 0.0] }", matrices,
                                 "normal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\n" + contact,
                                 "[[loads]]\ndirection = { d1 = 1.0 }\namplitude = -20.0"),
             "ida", "1e-8")
      .report.counters;
}

}  // namespace

TEST_CASE("one iteration a step where equations are linear, more where friction depends on the slip rate") {
  const Counters linear =
      effort_of("law = \"compliant\"\nnormal_stiffness = 1e3\ntangential_stiffness = 1e3\nfriction = 0.02");
  REQUIRE(linear.steps > 100);
  CHECK(linear.residuals == linear.solves);
  CHECK(linear.solves >= linear.steps);
  // IDA trusts no rate of convergence across a change of its matrix, and takes one more iteration there.
  CHECK(linear.solves <= linear.steps + linear.error_test_failures + linear.jacobians);
  CHECK(linear.convergence_failures == 0);
  const Counters bent =
      effort_of("law = \"rigid\"\nfriction = { static = 0.04, kinetic = 0.01, stribeck_velocity = 0.1 }");
  REQUIRE(bent.steps > 100);
  CHECK(bent.residuals == bent.solves);
  CHECK(bent.solves * linear.steps > linear.solves * bent.steps);
}
