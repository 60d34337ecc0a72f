#include "base/text.hpp"

#include <doctest/doctest.h>

using signorini::base::duration_text;

TEST_SUITE("unit/base/duration") {
  TEST_CASE("duration: seconds, minutes, hours, days") {
    CHECK(base::duration_text(0.0) == "1 s");
    CHECK(base::duration_text(7.2) == "8 s");
    CHECK(base::duration_text(59.6) == "1.0 min");
    CHECK(base::duration_text(75.0) == "1.2 min");
    CHECK(base::duration_text(1830.0) == "30 min");
    CHECK(base::duration_text(5400.0) == "1.5 h");
    CHECK(base::duration_text(180000.0) == "2.1 days");
  }
}
