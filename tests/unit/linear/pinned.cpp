#include "contact/contact_states.hpp"
#include "linear/undamped_motion.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace signorini;

TEST_SUITE_BEGIN("unit/linear/pinned");

TEST_CASE("motions along both directions of a contact are set exactly, also on an incline") {
  for (int degrees = 0; degrees < 360; degrees += 7) {
    CAPTURE(degrees);
    const double c = std::cos(degrees * M_PI / 180.0), s = std::sin(degrees * M_PI / 180.0);
    const Combination n{{{1, -s}, {2, c}}}, t{{{2, s}, {1, c}}};
    Vector x = Vector::Constant(3, 1e-17);
    linear::set_exactly(n, 0.0, t, 0.0, x);
    CHECK(x[0] == 1e-17);
    CHECK(x[1] == 0.0);
    CHECK(x[2] == 0.0);
    linear::set_exactly(n, 0.0, t, 2.5, x);
    CHECK(std::abs(x[1] - 2.5 * c) < 1e-15);
    CHECK(std::abs(x[2] - 2.5 * s) < 1e-15);
    linear::set_exactly(n, -0.5, t, 0.0, x);
    CHECK(std::abs(x[1] - 0.5 * s) < 1e-15);
    CHECK(std::abs(x[2] + 0.5 * c) < 1e-15);
  }
}

TEST_CASE("forms of other degrees of freedom are left alone, single terms are set") {
  const Combination two{{{0, 0.6}, {1, 0.8}}}, other{{{1, 0.6}, {2, 0.8}}}, one{{{2, 4.0}}};
  Vector x = Vector::Constant(3, 1.0);
  linear::set_exactly(two, 0.0, other, 0.0, x);
  CHECK(x == Vector::Constant(3, 1.0));
  linear::set_exactly(two, 0.0, one, 2.0, x);
  CHECK(x[0] == 1.0);
  CHECK(x[2] == 0.5);
}

TEST_CASE("rows that hold a contact along both directions pin both degrees of freedom, one row none") {
  Model model;
  model.contacts.resize(1);
  model.layout = contact::layout_of(model.contacts);
  model.contacts[0].normal.terms = {{0, -0.6}, {1, 0.8}};
  model.contacts[0].tangent.terms = {{0, 0.8}, {1, 0.6}};
  std::vector<Rows> held(1);
  held[0].normal.an = 1.0;
  CHECK(linear::prescribed_dofs(model, held).empty());
  held[0].tangent.at = 1.0;
  const std::vector<linear::PrescribedDof> both = linear::prescribed_dofs(model, held);
  REQUIRE(both.size() == 2);
  const double r = 3.0, q = 5.0;
  double x[2] = {};
  for (const linear::PrescribedDof& p : both) x[p.dof] = (p.normal * r + p.tangent * q) / p.divisor;
  CHECK(-0.6 * x[0] + 0.8 * x[1] == doctest::Approx(r));
  CHECK(0.8 * x[0] + 0.6 * x[1] == doctest::Approx(q));
}

TEST_SUITE_END();
