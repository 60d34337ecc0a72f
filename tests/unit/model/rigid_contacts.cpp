#include <doctest/doctest.h>

#include <cmath>

#include "unit/model/scenes.hpp"

using namespace signorini;
using namespace signorini::test;

TEST_SUITE("unit/model/rigid_contacts") {
  TEST_CASE("a gap that is the rounding of its terms is closed at the start") {
    Scene s = empty_scene();
    s.nodes = {{"P", 0.0, 0.0, {}}};
    s.masses = {{"P", 1.0, 0.0, {}}};
    s.initial.components = {{"P", "uy", -0.3, {}}};
    ContactSpec c = support_contact("ground", "P", 0.0, 0.0);
    c.law = Law::rigid;
    c.tangential_stiffness.reset();
    c.gap = 0.1 + 0.2;  // one rounding above 0.3
    s.contacts = {c};
    REQUIRE(c.gap - 0.3 > 0.0);
    const Model model = build_model(s);
    CHECK(model.contacts[0].gap + model.contacts[0].normal.dot(model.u0) == 0.0);
  }

  TEST_CASE("the same where a run goes on, from whatever side the support pushes") {
    for (const double up : {1.0, -1.0}) {
      CAPTURE(up);
      Scene s = empty_scene();
      s.nodes = {{"P", 0.0, 0.0, {}}};
      s.masses = {{"P", 1.0, 0.0, {}}};
      ContactSpec c = support_contact("ground", "P", 0.0, 0.0);
      c.law = Law::rigid;
      c.normal = Direction{"P", {0.6 * up, 0.8 * up}, {}, {}};
      c.tangential_stiffness.reset();
      c.gap = 0.3 * (1.0 + 4e-15);
      s.contacts = {c};
      s.initial.saved = SavedState{};
      s.initial.saved->motions = {{"P.ux", -0.18 * up}, {"P.uy", -0.24 * up}, {"P.vx", 0.0}, {"P.vy", 0.0}};
      const Model model = build_model(s);
      CHECK(std::abs(model.contacts[0].gap_at(model.u0)) <= 1e-16);
      CHECK(model.contacts[0].gap_at(Vector(model.u0 * 0.999)) > 1e-4);
    }
  }
}
