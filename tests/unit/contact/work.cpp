#include "contact/work.hpp"

#include <doctest/doctest.h>

#include "contact/law.hpp"
#include "contact/motion.hpp"

using namespace signorini;

namespace {

Contact element() {
  Contact c;
  c.normal_stiffness = 100.0;
  c.normal_damping = 2.0;
  c.tangential_stiffness = 50.0;
  c.friction.static_ = 0.5;
  c.friction.kinetic = 0.4;
  return c;
}

}  // namespace

TEST_SUITE_BEGIN("unit/contact/work");

TEST_CASE("what forces do along a path, state by state") {
  const Contact c = element();
  const ContactIncrement path{0.3, 0.2, -0.1, -0.5, 0.25};
  const ContactWork slip = contact::work_on(c, State::slip_minus, -8.0, 3.0, path);
  CHECK(slip.friction == doctest::Approx(0.9));
  CHECK(slip.surface == doctest::Approx(-0.6));
  CHECK(slip.damping == doctest::Approx(0.1));
  CHECK(slip.applied_normal_force == doctest::Approx(2.0));
  CHECK(contact::work_on(c, State::stick, -8.0, 3.0, path).friction == 0.0);
  for (const State state : {State::open, State::inside})
    CHECK(contact::work_on(c, state, 0.0, 0.0, path).damping == 0.0);
}

TEST_CASE(
    "springs store what they are; a contact that is inside stores its gap, and its dashpot takes that") {
  const Contact c = element();
  ContactMotion m;
  m.N = -9.0;
  m.vn = -2.0;  // of it the dashpot bears -4
  m.T = 5.0;
  m.gap = -0.05;
  CHECK(contact::stored_energy(c, State::stick, m) == doctest::Approx(25.0 / 200.0 + 25.0 / 100.0));
  m.N = m.T = 0.0;
  CHECK(contact::stored_energy(c, State::inside, m) == doctest::Approx(0.125));
  CHECK(contact::stored_energy(c, State::open, m) == 0.0);
  CHECK(contact::dashpot_loss_inside(c, State::inside, -0.05, -0.01) == doctest::Approx(0.12));
  CHECK(contact::dashpot_loss_inside(c, State::open, -0.05, -0.01) == 0.0);
  CHECK(contact::dashpot_loss_inside(c, State::stick, -0.05, -0.01) == 0.0);
}

TEST_CASE("a contact that keeps its conditions violates none; each that is broken shows by how much") {
  const Contact c = element();
  ContactMotion m;
  m.gap = -0.05;
  m.vn = -2.0;
  m.N = -9.0;
  m.T = 3.0;
  m.vt = 1.0;
  CHECK(contact::violations(c, State::stick, m).gap == doctest::Approx(0.0));
  CHECK(contact::violations(c, State::stick, m).friction == doctest::Approx(3.0 - 4.5));
  CHECK(contact::violations(c, State::slip_minus, m).friction == doctest::Approx(3.0 - 3.6));
  // p' = ut' + s fk kn g'/kt = 1 - 0.4 * 100 * (-2) / 50
  CHECK(contact::violations(c, State::slip_minus, m).direction == doctest::Approx(-3.0 * (1.0 + 1.6)));
  CHECK(contact::violations(c, State::open, m).gap == doctest::Approx(0.05));
  CHECK(contact::violations(c, State::open, m).tension == -9.0);
  CHECK(contact::violations(c, State::inside, m).gap == doctest::Approx(0.0));
  Contact rigid = c;
  rigid.law = Law::rigid;
  m.gap = 0.01;
  CHECK(contact::violations(rigid, State::closed, m).penetration == 0.01);
  CHECK(contact::violations(rigid, State::open, m).penetration == -0.01);
  CHECK(contact::violations(rigid, State::closed, m).product == doctest::Approx(0.09));
}

TEST_CASE("slip is what the tangential spring leaves of ut") {
  Contact c = element();
  CHECK(contact::slip_of(c, 0.3, 5.0) == doctest::Approx(0.2));
  c.tangential_stiffness.reset();
  CHECK(contact::slip_of(c, 0.3, 5.0) == 0.3);
}

TEST_SUITE_END();
