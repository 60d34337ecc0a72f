#include "engine/events/active_guards.hpp"

#include <doctest/doctest.h>

using namespace signorini;

TEST_SUITE_BEGIN("unit/engine/events/active_guards");

TEST_CASE("guards that start clear of zero are armed; the others wait until they have clearly risen") {
  events::ActiveGuards arming;
  decide::GuardStart idle, clear{Guard::closing}, rising{Guard::closing, true, 2, 0.0},
      hidden{Guard::sliding, true, -1, 0.0};
  arming.start({idle, clear, rising, hidden});
  REQUIRE(arming.size() == 4);
  CHECK(arming.idle(0));
  CHECK_FALSE(arming.armed(0));
  CHECK(arming.armed(1));
  CHECK_FALSE(arming.armed(2));
  CHECK_FALSE(arming.idle(2));
  CHECK(arming.leading_order(2) == 2);
  CHECK(arming.leading_order(3) == 0);
  arming.update(0, 1.0, 0.1);
  CHECK(arming.idle(0));
  arming.update(1, -1.0, 0.1);
  CHECK(arming.armed(1));
  arming.update(2, 0.05, 0.1);  // a step on, not yet above the level: what it began with says no more
  CHECK_FALSE(arming.armed(2));
  CHECK(arming.leading_order(2) == 0);
  arming.update(2, 0.2, 0.1);
  CHECK(arming.armed(2));
  arming.set_armed(3);
  CHECK(arming.armed(3));
}

TEST_SUITE_END();
