#include <doctest/doctest.h>

#include "unit/model/scenes.hpp"

using namespace signorini;
using namespace signorini::test;

TEST_SUITE("unit/model/assembly/contacts") {
  TEST_CASE("a slider of a node scene without tangent and normal is refused by name") {
    Scene s = empty_scene();
    s.nodes = {{"P", 0.0, 0.0, {}}};
    s.masses = {{"P", 1.0, 0.0, {}}};
    ContactSpec c = slider("plate", {}, 10.0, 0.3);
    c.tangent.reset();
    s.contacts = {c};
    CHECK(contains(refusal(s), "a slider needs a tangent"));
  }
}
