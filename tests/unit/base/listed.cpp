#include "base/text.hpp"

#include <doctest/doctest.h>

using namespace signorini;

TEST_SUITE_BEGIN("unit/base/listed");

TEST_CASE("names in a sentence") {
  CHECK(base::listed({}).empty());
  CHECK(base::listed({"A"}) == "'A'");
  CHECK(base::listed({"A", "B"}) == "'A' and 'B'");
  CHECK(base::listed({"A", "B", "C"}) == "'A', 'B' and 'C'");
  CHECK(base::listed({"A", "B", "C"}, 3) == "'A', 'B' and 'C'");
  CHECK(base::listed({"A", "B", "C", "D"}, 2) == "'A', 'B' and 2 more");
  CHECK(base::listed_plainly({"ux of A", "uy"}) == "ux of A and uy");
}

TEST_SUITE_END();
