#include "contact/law.hpp"

#include <doctest/doctest.h>

using namespace signorini;

namespace {

Contact element() {
  Contact c;
  c.name = "c";
  c.law = Law::compliant;
  c.normal_stiffness = 1000.0;
  c.tangential_stiffness = 500.0;
  c.friction.static_ = 0.4;
  c.friction.kinetic = 0.3;
  return c;
}

MotionJet jet(ContactMotion m, ContactMotion rate = {}) {
  MotionJet j;
  j.motion[0] = m;
  j.motion[1] = rate;
  return j;
}

}  // namespace

TEST_SUITE_BEGIN("unit/contact/law");

TEST_CASE("rows vanish exactly on the law of each state") {
  const Contact c = element();
  ContactMotion m;
  m.gap = -0.002;
  m.ut = 0.0007;
  m.N = -2.0;  // kn g
  SUBCASE("stick: T = kt (ut - p)") {
    m.T = 500.0 * (0.0007 - 0.0002);
    const Rows r = contact::rows(c, {State::stick, 0.0002});
    CHECK(r.normal.value(m) == doctest::Approx(0.0));
    CHECK(r.tangent.value(m) == doctest::Approx(0.0));
  }
  SUBCASE("slip: T = -s fk N, along the slip") {
    m.T = 0.6;
    CHECK(contact::rows(c, {State::slip_plus, 0.0}).tangent.value(m) == doctest::Approx(0.0));
    m.T = -0.6;
    CHECK(contact::rows(c, {State::slip_minus, 0.0}).tangent.value(m) == doctest::Approx(0.0));
  }
  SUBCASE("open: no force") {
    const Rows r = contact::rows(c, {State::open, 0.0});
    CHECK(r.normal.value(m) == -2.0);  // a force is the whole residual
    CHECK(r.normal.gap == 0.0);
    CHECK(r.tangent.T == 1.0);
  }
}

TEST_CASE("guards are positive inside their state and vanish at its edge") {
  const Contact c = element();
  ContactMotion m;
  m.N = -2.0;
  m.T = 0.79;
  auto g = contact::guards(c, {State::stick, 0.0});
  CHECK(g[0].kind == Guard::separation);
  CHECK(g[0].form.value(m) == 2.0);
  CHECK(g[1].form.value(m) == doctest::Approx(0.01));  // static: 0.4 * 2 - 0.79
  CHECK(g[2].form.value(m) == doctest::Approx(1.59));
  m.T = 0.8;
  CHECK(g[1].form.value(m) == doctest::Approx(0.0));
}

TEST_CASE("the slip rate is that of the anchor, not of the node") {
  // T = -s fk N and T = kt (ut - p): p' = ut' - T'/kt = ut' + s fk (kn/kt) g'
  const Contact c = element();
  ContactMotion m;
  m.vt = 0.01;
  m.vn = -0.02;  // N grows, so T grows, part of ut' is elastic
  CHECK(contact::slip_rate(c, 1).value(m) == doctest::Approx(0.01 + 0.3 * 2.0 * -0.02));
  const GuardForm g = contact::guards(c, {State::slip_minus, 0.0})[1];
  CHECK(g.form.value(m) == doctest::Approx(-(0.01 - 0.3 * 2.0 * -0.02)));
}

TEST_CASE("sliders never open, their rate follows the compression") {
  Contact c = element();
  c.law = Law::slider;
  CHECK(contact::guards(c, {State::stick, 0.0})[0].kind == Guard::none);
  ContactMotion m;
  m.vt = 1.0;
  m.applied_normal_force_rate = 3.0;
  CHECK(contact::slip_rate(c, 1).value(m) == doctest::Approx(1.0 - 0.3 * 3.0 / 500.0));
  c.tangential_stiffness.reset();
  CHECK(contact::slip_rate(c, 1).value(m) == 1.0);
  CHECK(contact::rows(c, {State::stick, 0.0}).tangent.at == 1.0);
}

TEST_CASE("closing is the apex of the cone: only the directions compare") {
  const Contact c = element();
  const auto closes = [&](double vt, double vn) {
    ContactMotion rate;
    rate.gap = vn;
    rate.ut = vt;
    return contact::next_state(c, {State::open, 0.0}, Guard::closing, jet({}, rate)).state;
  };
  CHECK(closes(0.79, -1.0) == State::stick);  // 500 * 0.79 < 0.4 * 1000
  CHECK(closes(0.81, -1.0) == State::slip_plus);
  CHECK(closes(-0.81, -1.0) == State::slip_minus);
}

TEST_CASE("closing at an order at which one direction alone moves: what moves there decides") {
  const Contact c = element();
  MotionJet j = jet({});
  for (std::size_t m = 0; m < MotionJet::orders; ++m) j.noise[m].gap = j.noise[m].ut = 1e-9;
  const auto closes = [&] { return contact::next_state(c, {State::open, 0.0}, Guard::closing, j).state; };
  SUBCASE("straight down: it sticks, however fast it moves along at the next order") {
    j.motion[1].gap = -1.0;
    j.motion[2].gap = -1.0;
    j.motion[2].ut = 5.0;  // 500 * 5 > 0.4 * 1000
    CHECK(closes() == State::stick);
  }
  SUBCASE("along alone, which the gap follows at the next order: it slips") {
    j.motion[1].ut = -0.01;
    j.motion[2].gap = -1.0;
    j.motion[2].ut = 0.1;
    CHECK(closes() == State::slip_minus);
  }
  SUBCASE("less than the noise of either is no motion: the next order decides") {
    j.motion[1].gap = -0.5e-9;
    j.motion[1].ut = 0.9e-9;
    j.motion[2].gap = -1.0;
    j.motion[2].ut = 0.9;
    CHECK(closes() == State::slip_plus);
  }
}

TEST_CASE("anchors keep T continuous, and drop it where static exceeds kinetic friction") {
  const Contact c = element();
  ContactMotion m;
  m.N = -2.0;
  m.T = 0.8;
  m.ut = 0.01;
  const ContactState slipping = contact::next_state(c, {State::stick, 0.0084}, Guard::slip_plus, jet(m));
  CHECK(slipping.state == State::slip_plus);
  CHECK(slipping.anchor == doctest::Approx(0.01 - 0.6 / 500.0));
  m.T = 0.6;
  const ContactState stuck = contact::next_state(c, slipping, Guard::sliding, jet(m));
  CHECK(stuck.state == State::stick);
  CHECK(500.0 * (m.ut - stuck.anchor) == doctest::Approx(0.6));
}

TEST_SUITE_END();
