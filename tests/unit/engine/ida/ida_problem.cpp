#include "engine/ida/ida_problem.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "behaviour/one_mass.hpp"
#include "engine/tolerance.hpp"

using namespace signorini;

namespace {

Model coupled(const std::string& contact) {
  return build_model(
      parse_scene(tests::matrix_scene("t_end = 1.0\ninitial = { u = [0.0, 0.0, 0.0], v = [0.0, 0.0, 0.0] }",
                                      "mass = [[2.0, 0.3, 0.1], [0.3, 1.7, 0.2], [0.1, 0.2, 1.3]]\nstiffness "
                                      "= [[70.0, -33.0, -7.0], [-33.0, 91.0, -11.0], [-7.0, -11.0, 57.0]]",
                                      contact),
                  "test.toml"));
}

decide::Decision sticking(const Model& model) {
  decide::Decision decision;
  decision.states = {{State::stick, 0.0}};
  decision.guards.resize(model.layout.guard_count());
  decide::GuardCache guards(model);
  (void)guards.of(0, decision.states[0]);
  decision.forms = guards.all();
  return decision;
}

}  // namespace

TEST_SUITE_BEGIN("unit/engine/ida/ida_problem");

TEST_CASE("no tolerance of a force lies below the rounding of the difference that it is") {
  const Model model = coupled(
      "law = \"compliant\"\nnormal = { d0 = 1.0 }\ntangent = { d1 = 1.0 }\nnormal_stiffness = 1e12\n"
      "tangential_stiffness = 1e11\nfriction = 0.3\ngap = 2.0");
  engine::Tolerance tolerance;
  tolerance.rtol = 1e-12;
  tolerance.displacement = tolerance.velocity = tolerance.force = 1e-12;
  const linear::SystemMatrices structure(model);
  const motion::Forcing forcing(model, 0.0, motion::Side::after);
  ida::IdaProblem problem(model, structure, tolerance);
  const decide::Decision decision = sticking(model);
  const events::GuardMonitor watch;
  problem.start({1.0, &decision, &forcing}, watch);
  std::vector<double> y(8, 0.0), w(8);
  y[0] = -3.0;
  y[1] = 0.5;
  problem.weights(y.data(), 0.0, w.data());
  // In the norm of the group of N and T, of which a step may spend a fifth.
  const double part = std::sqrt(8.0 / 2.0) / 0.2, epsilon = std::numeric_limits<double>::epsilon();
  CHECK(part / w[6] == doctest::Approx(20.0 * epsilon * 1e12 * 5.0));
  CHECK(part / w[7] == doctest::Approx(20.0 * epsilon * 1e11 * 0.5));
}

TEST_CASE(
    "no tolerance of a force that stops a mass lies below what a rounding of its velocity takes in a step") {
  const Model model =
      coupled("law = \"rigid\"\nnormal = { d0 = 3.0 }\ntangent = { d1 = 7.0 }\nfriction = 0.3");
  engine::Tolerance tolerance;
  tolerance.rtol = tolerance.displacement = tolerance.velocity = tolerance.force = 1e-14;
  const linear::SystemMatrices structure(model);
  const motion::Forcing forcing(model, 0.0, motion::Side::after);
  ida::IdaProblem problem(model, structure, tolerance);
  const decide::Decision decision = sticking(model);
  const events::GuardMonitor watch;
  problem.start({1.0, &decision, &forcing}, watch);
  std::vector<double> y(8, 0.0), w(8);
  y[3] = -0.5;
  y[4] = 0.25;
  const double part = std::sqrt(8.0 / 2.0) / 0.2, epsilon = std::numeric_limits<double>::epsilon();
  problem.weights(y.data(), 1e6, w.data());
  CHECK(part / w[6] == doctest::Approx(20.0 * epsilon * (2.0 / 9.0) * 1e6 * 3.0 * 0.5));
  CHECK(part / w[7] == doctest::Approx(20.0 * epsilon * (1.7 / 49.0) * 1e6 * 7.0 * 0.25));
  problem.weights(y.data(), 0.0, w.data());
  CHECK(part / w[6] == doctest::Approx(1e-14));
}

TEST_CASE("the acceleration of a held degree of freedom is exactly what its contact says") {
  const Model model =
      coupled("law = \"rigid\"\nnormal = { d0 = 3.0 }\ntangent = { d1 = 7.0 }\nfriction = 0.3");
  const linear::SystemMatrices structure(model);
  const ida::Layout layout(model);
  ida::IdaLinearSolver solver(model, structure, layout);
  solver.set_contact_states({{State::stick, 0.0}});
  for (int i = 1; i <= 20; ++i) {
    CAPTURE(i);
    solver.set_cj(0.37 * i * i);
    REQUIRE(solver.factor());
    std::vector<double> b(8), x(8);
    for (std::size_t j = 0; j < b.size(); ++j)
      b[j] = std::sin(static_cast<double>(i) + 3.7 * static_cast<double>(j));
    solver.solve(b.data(), x.data());
    CHECK(x[3] == b[6] / (solver.cj() * 3.0));
    CHECK(x[4] == b[7] / (solver.cj() * 7.0));
  }
}

TEST_SUITE_END();
