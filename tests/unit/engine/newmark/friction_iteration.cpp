#include <doctest/doctest.h>

#include "behaviour/one_mass.hpp"
#include "unit/engine/stretch.hpp"

namespace signorini::tests::friction_iterations {
namespace {

/// A block that friction stops: u'' = -1, u' = 1 - t, at rest from t = 1 on.
std::string block(const std::string& more = "") {
  return matrix_scene(
      "t_end = 3.0\ninitial = { u = [0.0], v = [1.0] }", "mass = [[2.0]]\nstiffness = [[0.0]]",
      "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 4.0\nfriction = 0.5\n" + more);
}

}  // namespace

TEST_SUITE_BEGIN("unit/engine/newmark/friction_iteration");

TEST_CASE(
    "a block slides as average acceleration has it, and stops at the end of the step in which it would "
    "turn") {
  Stretch s(block(), {{"run.engine", "friction-iteration"}, {"run.dt", "0.3"}});
  REQUIRE(s.decision.states[0].state == State::slip_plus);
  std::vector<double> ends, u, v;
  motion::WorkIntegrals works(1);
  const engine::Step last = s.go([&](const engine::Step& step) {
    ends.push_back(step.end);
    const motion::Point p = s.at(step.end);
    u.push_back(p.u[0]);
    v.push_back(p.v[0]);
    CHECK(std::abs(p.T(s.model.layout, 0)) <= 2.0 * (1.0 + 1e-12));
    CHECK(p.N(s.model.layout, 0) == -4.0);
    s.engine->dense_output().integrate(step.begin, step.end, works);
    CHECK(s.engine->dense_output().residual() < 1e-14);
  });
  REQUIRE(ends.size() == 4);
  for (std::size_t i = 0; i < 3; ++i) {
    const double t = 0.3 * static_cast<double>(i + 1);
    CHECK(ends[i] == doctest::Approx(t).epsilon(1e-15));
    CHECK(u[i] == doctest::Approx(t - 0.5 * t * t).epsilon(1e-14));
    CHECK(v[i] == doctest::Approx(1.0 - t).epsilon(1e-14));
  }
  // Held from 0.9 on: v = 0 at 1.2, and the mean velocity moves it by 0.3 (0.1 + 0) / 2.
  REQUIRE(last.kind == engine::Step::Kind::event);
  REQUIRE(last.engine_states);
  CHECK((*last.engine_states)[0].state == State::stick);
  CHECK(last.triggered.empty());
  CHECK(ends[3] == doctest::Approx(1.2).epsilon(1e-15));
  CHECK(u[3] == doctest::Approx(0.51).epsilon(1e-14));
  CHECK(std::abs(v[3]) < 1e-15);
  CHECK(works.applied_normal_force[0] == doctest::Approx(4.0 * 1.2).epsilon(1e-14));
  // On a straight line inside of the step, with the forces of the state that ends there.
  const motion::Point inside = s.at(1.05);
  CHECK(inside.u[0] == doctest::Approx(0.5 * (0.495 + 0.51)).epsilon(1e-14));
  CHECK(inside.v[0] == doctest::Approx(0.05).epsilon(1e-13));
  CHECK(inside.T(s.model.layout, 0) == doctest::Approx(2.0).epsilon(1e-13));
  REQUIRE(s.pass(last));
  CHECK(s.decision.states[0].state == State::stick);
  const engine::Step rest = s.go();
  CHECK(rest.end == 3.0);
  CHECK(s.at(3.0).u[0] == doctest::Approx(0.51).epsilon(1e-14));
}

TEST_CASE("steps end at multiples of dt, and the last one at the end") {
  Stretch s(block(), {{"run.engine", "friction-iteration"}, {"run.dt", "0.3"}, {"run.t_end", "0.7"}});
  std::vector<double> ends;
  const engine::Step last = s.go([&](const engine::Step& step) { ends.push_back(step.end); });
  CHECK(last.kind == engine::Step::Kind::accepted);
  REQUIRE(ends.size() == 3);
  CHECK(ends[1] == doctest::Approx(0.6).epsilon(1e-15));
  CHECK(ends[2] == 0.7);
  CHECK(s.at(0.7).u[0] == doctest::Approx(0.7 - 0.245).epsilon(1e-14));
}

TEST_SUITE_END();

}  // namespace signorini::tests::friction_iterations
