#include "engine/newmark/newmark_step.hpp"

#include <doctest/doctest.h>

#include "behaviour/one_mass.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/engine/newmark/newmark_works");

TEST_CASE("works of a step are those of mean forces on the way between its ends") {
  const Model model = build_model(parse_scene(
      tests::matrix_scene("t_end = 1.0\ninitial = { u = [0.0, 0.0], v = [0.0, 0.0] }",
                          "mass = [[1.0, 0.0], [0.0, 1.0]]\ndamping = [[0.6, 0.0], [0.0, 0.0]]\n"
                          "stiffness = [[0.0, 0.0], [0.0, 0.0]]",
                          "law = \"compliant\"\nnormal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\n"
                          "normal_stiffness = 100.0\nnormal_damping = 2.0\ntangential_stiffness = 50.0\n"
                          "friction = 0.4\nsurface_velocity = 1.5"),
      "test.toml"));
  const linear::SystemMatrices structure(model);
  const motion::Forcing forcing(model, 0.0, motion::Side::after);
  motion::Point a{Vector(2), Vector(2), Vector(2)}, b = a;
  a.u << 0.1, -0.03;
  a.v << 2.0, -1.0;
  a.forces << -2.0, 1.0;
  b.u << 0.6, -0.05;
  b.v << 4.0, 0.5;
  b.forces << -4.0, 3.0;
  const double h = 0.2, ds = 1.5 * h, T = 2.0;
  newmark::NewmarkWorkIntegrals steps(model, structure);
  const auto works_in = [&](State state) {
    motion::WorkIntegrals works(1);
    steps.add(forcing, {{state, 0.0}}, a, 0.0, b, h, 1.0, works);
    return works;
  };
  const motion::WorkIntegrals slip = works_in(State::slip_minus);
  CHECK(slip.applied_normal_force[0] == doctest::Approx(3.0 * h));
  CHECK(slip.surface[0] == doctest::Approx(-T * ds));
  CHECK(slip.friction[0] == doctest::Approx(T * (0.5 - ds - 2.0 / 50.0)));
  CHECK(slip.damping == doctest::Approx(h * 0.6 * 9.0 + 2.0 * -0.25 * -0.02));
  CHECK(works_in(State::stick).friction[0] == 0.0);
  CHECK(works_in(State::open).damping == doctest::Approx(h * 0.6 * 9.0));
  CHECK(works_in(State::inside).damping == doctest::Approx(h * 0.6 * 9.0 + 50.0 * (0.0009 - 0.0025)));
}

TEST_SUITE_END();
