// Names of motions and their units.
#include "scene/components.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace signorini;

namespace signorini::tests::components {

void is_unit(const std::string& name, const Unit& expected) {
  CAPTURE(name);
  const Unit of = scene::motion_named(name).unit();
  CHECK(of.force == expected.force);
  CHECK(of.length == expected.length);
  CHECK(of.time == expected.time);
}

TEST_SUITE_BEGIN("unit/scene/components");

TEST_CASE("a motion's unit follows from its component, whatever stands before it") {
  for (const char* before : {"", "A.", "vx.", "wz.", "A-B.3.", "A-B.A.", "support B."}) {
    const std::string at = before;
    for (const char* translation : {"ux", "uy"}) is_unit(at + translation, {0, 1, 0});
    for (const char* rate : {"vx", "vy"}) is_unit(at + rate, {0, 1, -1});
    is_unit(at + "rz", {0, 0, 0});
    is_unit(at + "wz", {0, 0, -1});
  }
  is_unit("d0.u", {0, 1, 0});
  is_unit("d0.v", {0, 1, -1});
  is_unit("wz.slip", {0, 1, 0});
  is_unit("first.surface", {0, 1, 0});
}

TEST_CASE("names stand for components, others for none") {
  std::size_t index = 0;
  for (const char* name : {"ux", "uy", "rz", "vx", "vy", "wz"}) {
    const auto named = scene::component_named(name);
    REQUIRE(named);
    CHECK(named->index == index % 3);
    CHECK(named->rate == (index >= 3));
    CHECK(named->name() == name);
    CHECK(named->component().rotation == (index % 3 == 2));
    ++index;
  }
  for (const char* name : {"", "u", "v", "x", "ux.", "uxx", "slip"})
    CHECK_FALSE(scene::component_named(name));
}

TEST_CASE("columns of displacements are told from rates and from all else") {
  for (const char* column : {"A.ux", "A-B.3.uy", "wz.rz", "d0.u"}) CHECK(scene::is_displacement(column));
  for (const char* column : {"A.vx", "A.vy", "ux.wz", "d0.v", "t", "u", "first.slip", "d.uu"})
    CHECK_FALSE(scene::is_displacement(column));
  CHECK(scene::motion_named("A.rz").rotation);
  CHECK_FALSE(scene::motion_named("d0.v").rotation);
}

TEST_SUITE_END();

}  // namespace signorini::tests::components
