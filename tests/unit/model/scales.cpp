#include <doctest/doctest.h>

#include "unit/model/scenes.hpp"

using namespace signorini;
using namespace signorini::test;

TEST_SUITE("unit/model/scales") {
  TEST_CASE("scales do not depend on where the structure stands") {
    Scene s = beam(8.0, 4, 9e6, 2e6, 0.4);
    s.nodes[1].y = 3.0;
    s.gravity = {0.0, -9.81};
    s.initial.is_static = true;
    s.contacts = {support_contact("left", "L", 1e5), support_contact("right", "R", 3e5)};
    const Scales here = build_model(s).scales;
    for (Node& node : s.nodes) {
      node.x += 1024.0;
      node.y -= 512.0;
    }
    const Scales there = build_model(s).scales;
    CHECK(there.rotation == doctest::Approx(here.rotation));
    CHECK(there.angular_velocity == doctest::Approx(here.angular_velocity));
    CHECK(there.displacement == doctest::Approx(here.displacement));
  }
}
