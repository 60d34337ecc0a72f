#include "base/text.hpp"

#include <doctest/doctest.h>

using namespace signorini;

TEST_SUITE_BEGIN("unit/base/suggest");

TEST_CASE("suggestions") {
  CHECK(edit_distance("friction", "frictoin") == 1);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(nearest("Friction", {"gap", "friction"}) == "friction");
  CHECK(nearest("colour", {"gap", "friction"}).empty());
  CHECK(suggestion("x", {"gap", "law"}) == "; known: gap, law");
  CHECK(suggestion("x", {}).empty());
}

TEST_SUITE_END();
