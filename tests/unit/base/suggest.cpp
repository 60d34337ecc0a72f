#include "base/text.hpp"

#include <doctest/doctest.h>

using namespace signorini;

TEST_SUITE_BEGIN("unit/base/suggest");

TEST_CASE("suggestions") {
  CHECK(base::edit_distance("friction", "frictoin") == 1);
  CHECK(base::edit_distance("", "abc") == 3);
  CHECK(base::nearest_name("Friction", {"gap", "friction"}) == "friction");
  CHECK(base::nearest_name("colour", {"gap", "friction"}).empty());
  CHECK(base::suggestion("x", {"gap", "law"}) == "; known: gap, law");
  CHECK(base::suggestion("x", {}).empty());
}

TEST_SUITE_END();
