#include "study/figures.hpp"

#include <doctest/doctest.h>

using namespace signorini;

TEST_SUITE("unit/study/figures") {
  TEST_CASE("the unit of a key is that of its place in the scene, in the scene's words") {
    const Units units{"kN", "t", "m", "s"};
    CHECK(key_unit("contacts.left.normal_stiffness", units) == "kN/m");
    CHECK(key_unit("contacts.*.friction", units).empty());
    CHECK(key_unit("loads.1.amplitude", units) == "kN");
    CHECK(key_unit("sections.line.pipe.wall", units) == "m");
    CHECK(key_unit("sections.line.pipe.insulation.thickness", units) == "m");
    CHECK(key_unit("members.2.bend.radius", units) == "m");
    CHECK(key_unit("springs.*.hanger.cold", units) == "kN");
    CHECK(key_unit("members.2.bend.sif", units).empty());
    CHECK(key_unit("loads.1.moment", units) == "kN m");
    CHECK(key_unit("sections.column.EI", units) == "kN m^2");
    CHECK(key_unit("sections.column.mass_per_length", units) == "t/m");
    CHECK(key_unit("run.t_end", units) == "s");
    CHECK(key_unit("contacts.a.friction.static", units).empty());
    CHECK(key_unit("nobody.knows", units).empty());
    CHECK(key_unit("title", units).empty());
    CHECK(key_with_unit("contacts.1.gap", units) == "contacts.1.gap [m]");
    CHECK(key_with_unit("contacts.1.friction", units) == "contacts.1.friction");
  }
}
