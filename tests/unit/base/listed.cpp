#include "base/text.hpp"

#include <doctest/doctest.h>

using namespace signorini;

TEST_SUITE_BEGIN("unit/base/listed");

TEST_CASE("names in a sentence") {
  CHECK(base::join_quoted({}).empty());
  CHECK(base::join_quoted({"A"}) == "'A'");
  CHECK(base::join_quoted({"A", "B"}) == "'A' and 'B'");
  CHECK(base::join_quoted({"A", "B", "C"}) == "'A', 'B' and 'C'");
  CHECK(base::join_quoted({"A", "B", "C"}, 3) == "'A', 'B' and 'C'");
  CHECK(base::join_quoted({"A", "B", "C", "D"}, 2) == "'A', 'B' and 2 more");
  CHECK(base::join_texts({"ux of A", "uy"}) == "ux of A and uy");
}

TEST_SUITE_END();
