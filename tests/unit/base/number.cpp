#include "base/text.hpp"

#include <doctest/doctest.h>

#include <limits>

using namespace signorini;

TEST_SUITE_BEGIN("unit/base/number");

TEST_CASE("numbers read back exactly in the fewest digits") {
  CHECK(base::format_number(0.1) == "0.1");
  CHECK(base::format_number(100.0) == "100");
  CHECK(base::format_number(1e-8) == "1e-08");
  for (const double x : {0.1 + 0.2, 1.0 / 3.0, 5e-324, std::numeric_limits<double>::max(), -0.0}) {
    CHECK(base::parse_number(base::format_number(x)) == x);
  }
  CHECK(base::parse_number("+2.5e0") == 2.5);
  for (const char* text : {"", "1,5", "1.5 ", "abc", "+-1", "+"}) CHECK_FALSE(base::parse_number(text));
  CHECK(base::parse_integer("12") == 12);
  CHECK_FALSE(base::parse_integer("99999999999999999999"));
}

TEST_SUITE_END();
