// The hard cases, short: validation/hard-cases runs them long and prints what they measure.
#include <doctest/doctest.h>

#include "behaviour/engines.hpp"
#include "behaviour/hard_cases.hpp"

using namespace signorini::tests;

TEST_SUITE("behaviour/hard cases") {
  TEST_CASE("each hard case is within its bound, by both engines") {
    for (const HardCase& hard : hard_cases())
      for (const std::string& engine : engines) {
        CAPTURE(hard.name);
        CAPTURE(engine);
        CHECK(hard.error(engine, 1.0) <= (engine == "exact" ? hard.exact : hard.ida));
      }
  }
}
