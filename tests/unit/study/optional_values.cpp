#include "study/optional_values.hpp"

#include <doctest/doctest.h>

using namespace signorini;

TEST_SUITE("unit/study/optional_values") {
  TEST_CASE("the unit of a key is that of its place in the scene, in the scene's words") {
    const Units units{"kN", "t", "m", "s"};
    CHECK(study::key_unit("contacts.left.normal_stiffness", units) == "kN/m");
    CHECK(study::key_unit("contacts.*.friction", units).empty());
    CHECK(study::key_unit("loads.1.amplitude", units) == "kN");
    CHECK(study::key_unit("sections.line.pipe.wall", units) == "m");
    CHECK(study::key_unit("sections.line.pipe.insulation.thickness", units) == "m");
    CHECK(study::key_unit("members.2.bend.radius", units) == "m");
    CHECK(study::key_unit("springs.*.hanger.cold", units) == "kN");
    CHECK(study::key_unit("members.2.bend.sif", units).empty());
    CHECK(study::key_unit("loads.1.moment", units) == "kN m");
    CHECK(study::key_unit("sections.column.EI", units) == "kN m^2");
    CHECK(study::key_unit("sections.column.mass_per_length", units) == "t/m");
    CHECK(study::key_unit("run.t_end", units) == "s");
    CHECK(study::key_unit("contacts.a.friction.static", units).empty());
    CHECK(study::key_unit("nobody.knows", units).empty());
    CHECK(study::key_unit("title", units).empty());
    CHECK(study::key_with_unit("contacts.1.gap", units) == "contacts.1.gap [m]");
    CHECK(study::key_with_unit("contacts.1.friction", units) == "contacts.1.friction");
  }
}
