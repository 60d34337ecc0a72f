#include "base/text.hpp"

#include <doctest/doctest.h>

using namespace signorini;

TEST_SUITE_BEGIN("unit/base/listed");

TEST_CASE("names in a sentence") {
  CHECK(listed({}).empty());
  CHECK(listed({"A"}) == "'A'");
  CHECK(listed({"A", "B"}) == "'A' and 'B'");
  CHECK(listed({"A", "B", "C"}) == "'A', 'B' and 'C'");
  CHECK(listed({"A", "B", "C"}, 3) == "'A', 'B' and 'C'");
  CHECK(listed({"A", "B", "C", "D"}, 2) == "'A', 'B' and 2 more");
  CHECK(listed_plainly({"ux of A", "uy"}) == "ux of A and uy");
}

TEST_SUITE_END();
