#include "contact/law/yielding_pad.hpp"

#include <doctest/doctest.h>

#include "contact/law.hpp"

using namespace signorini;

namespace {

// kn = 1000, Y = 20: elastic over 0.02.
Contact pad() {
  Contact c;
  c.name = "pad";
  c.law = Law::compliant;
  c.normal_stiffness = 1000.0;
  c.law = std::make_shared<const UserContactLaw>(yielding_pad(1000.0, 20.0));
  return c;
}

ContactState off(double p) { return {user_law_state(0, State::open), p}; }
ContactState elastic(double p) { return {user_law_state(1, State::closed), p}; }
ContactState crushed(double p) { return {user_law_state(2, State::slip_minus), p}; }

ContactMotion at(double gap, double N, double vn = 0.0) {
  ContactMotion m;
  m.gap = gap;
  m.N = N;
  m.vn = vn;
  return m;
}

}  // namespace

TEST_SUITE_BEGIN("unit/contact/law/yielding_pad");

TEST_CASE("yielding pad: rows are N = 0, N = kn (g - p), N = -Y, and T = 0") {
  const Contact c = pad();
  CHECK(contact::rows(c, off(-0.1)).normal.value(at(0.3, 0.0)) == 0.0);
  CHECK(contact::rows(c, off(-0.1)).normal.value(at(0.3, -2.0)) == -2.0);
  CHECK(contact::rows(c, elastic(-0.1)).normal.value(at(-0.11, -10.0)) == doctest::Approx(0.0));
  CHECK(contact::rows(c, elastic(-0.1)).normal.value(at(-0.11, -11.0)) == doctest::Approx(-1.0));
  CHECK(contact::rows(c, crushed(-0.1)).normal.value(at(-0.4, -20.0)) == 0.0);
  for (const ContactState& state : {off(0.0), elastic(0.0), crushed(0.0)}) {
    ContactMotion m = at(-0.01, -10.0, -3.0);
    m.ut = 0.5;
    m.vt = 2.0;
    CHECK(contact::rows(c, state).tangent.value(m) == 0.0);
    m.T = 4.0;
    CHECK(contact::rows(c, state).tangent.value(m) == 4.0);
  }
}

TEST_CASE("yielding pad: guards are positive inside their state and vanish at its edge") {
  const Contact c = pad();
  const auto value = [&](const ContactState& state, std::size_t i, const ContactMotion& m) {
    return contact::guards(c, state)[i].form.value(m);
  };
  CHECK(value(off(-0.1), 0, at(-0.09, 0.0)) == doctest::Approx(0.01));
  CHECK(value(off(-0.1), 0, at(-0.1, 0.0)) == 0.0);
  CHECK(value(elastic(0.0), 0, at(-0.01, -10.0)) > 0.0);  // presses
  CHECK(value(elastic(0.0), 0, at(0.0, 0.0)) == 0.0);
  CHECK(value(elastic(0.0), 1, at(-0.01, -10.0)) > 0.0);  // does not yield
  CHECK(value(elastic(0.0), 1, at(-0.02, -20.0)) == 0.0);
  CHECK(value(crushed(0.0), 0, at(-0.05, -20.0, -0.3)) > 0.0);  // is crushed further
  CHECK(value(crushed(0.0), 0, at(-0.05, -20.0, 0.0)) == 0.0);
}

TEST_CASE("yielding pad: the dent is what unloading leaves, and only crushing moves it") {
  const Contact c = pad();
  const auto next = [&](const ContactState& state, Guard guard, const ContactMotion& m) {
    MotionJet jet;
    jet.motion[0] = m;
    return contact::next_state(c, state, guard, jet);
  };
  CHECK(next(off(-0.1), Guard::user_1, at(-0.1, 0.0, -1.0)) == elastic(-0.1));
  CHECK(next(elastic(-0.1), Guard::user_1, at(-0.1, 0.0, 1.0)) == off(-0.1));
  CHECK(next(elastic(-0.1), Guard::user_2, at(-0.12, -20.0, -1.0)) == crushed(-0.1));
  const ContactState unloads = next(crushed(-0.1), Guard::user_1, at(-0.35, -20.0));
  CHECK(unloads.state == user_law_state(1, State::closed));
  CHECK(unloads.anchor == doctest::Approx(-0.33));
  CHECK(contact::rows(c, unloads).normal.value(at(-0.35, -20.0)) == doctest::Approx(0.0));  // N stays
}

TEST_CASE("a law is named as in a scene file; laws without a name are compliant, as before") {
  Contact c = pad();
  CHECK(c.law->name() == "yielding");
  c.law = std::make_shared<const UserContactLaw>();
  CHECK(c.law->name() == "compliant");
  c.law = Law::compliant;
  CHECK(c.law->name() == "compliant");
  c.law = compliance_split_law();
  CHECK(c.law->name() == "rigid");
}

TEST_SUITE_END();
