#include "study/compare/alignment.hpp"

#include <doctest/doctest.h>

using signorini::compare::align;
using signorini::compare::Alignment;
using signorini::compare::LoggedEvent;

namespace {

using Events = std::vector<LoggedEvent>;

LoggedEvent slip(double t, const char* contact, double uncertainty = 0.0) {
  return {t, contact, "slip", "stick", "slip+", uncertainty};
}
LoggedEvent stick(double t, const char* contact, double uncertainty = 0.0) {
  return {t, contact, "stick", "slip+", "stick", uncertainty};
}
LoggedEvent load(double t) { return {t, "", "time", "", "", 0.0}; }

Alignment aligned(const Events& a, const Events& b, double t_end = 10.0) { return align(a, b, {t_end, 0.0}); }

}  // namespace

TEST_SUITE_BEGIN("unit/study/compare/alignment");

TEST_CASE("alignment: the same list, at other times") {
  const Alignment a =
      aligned({slip(1, "a"), stick(2, "a"), slip(3, "b")}, {slip(1.1, "a"), stick(1.9, "a"), slip(3.2, "b")});
  REQUIRE(a.pairs.size() == 3);
  CHECK_FALSE(a.split);
  CHECK(a.swapped == 0);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(a.pairs[i].reference == i);
    CHECK(a.pairs[i].other == i);
  }
  CHECK_FALSE(aligned({}, {}).split);
}

TEST_CASE("alignment: a missing event ends the list, and both sides are named") {
  const Alignment a =
      aligned({slip(1, "a"), stick(2, "a"), slip(3, "a")}, {slip(1, "a"), slip(4, "b"), stick(5, "b")});
  CHECK(a.pairs.size() == 1);
  REQUIRE(a.split);
  CHECK(a.split->t == 2.0);
  CHECK(a.split->reference == 1);
  CHECK(a.split->other == 1);
  CHECK(a.split->unaligned == 2);
}

TEST_CASE("alignment: the shorter list has no more") {
  const Events lower = {slip(1, "a")}, longer = {slip(1, "a"), stick(2, "a")};
  const Alignment missing = aligned(longer, lower), extra = aligned(lower, longer);
  REQUIRE(missing.split);
  CHECK(missing.split->reference == 1);
  CHECK_FALSE(missing.split->other);
  REQUIRE(extra.split);
  CHECK_FALSE(extra.split->reference);
  CHECK(extra.split->other == 1);
  CHECK(extra.split->t == 2.0);
  CHECK(extra.split->unaligned == 1);
}

TEST_CASE("alignment: an extra event of another contact in between is a difference") {
  const Alignment a = aligned({slip(1, "a"), stick(2, "a")}, {slip(1, "a"), slip(1.5, "b"), stick(2, "a")});
  CHECK(a.pairs.size() == 1);
  REQUIRE(a.split);
  CHECK(a.split->t == 1.5);
  CHECK(a.split->reference == 1);
  CHECK(a.split->other == 1);
}

TEST_CASE("alignment: another state after the event is a difference") {
  LoggedEvent other = slip(1, "a");
  other.to = "slip-";
  const Alignment a = aligned({slip(1, "a")}, {other});
  CHECK(a.pairs.empty());
  REQUIRE(a.split);
  CHECK(a.split->t == 1.0);
}

TEST_CASE("alignment: events of one instant have no order") {
  SUBCASE("in both lists") {
    const Alignment a = aligned({slip(1, "a"), slip(1, "b"), slip(1, "c"), stick(2, "a")},
                                {slip(1, "c"), slip(1, "a"), slip(1, "b"), stick(2, "a")});
    CHECK(a.pairs.size() == 4);
    CHECK_FALSE(a.split);
    CHECK(a.swapped == 0);
    CHECK(a.pairs[0].other == 1);
  }
  SUBCASE("in one list only: the other one had to choose") {
    const Alignment a = aligned({slip(1, "a"), slip(1, "b")}, {slip(0.9, "b"), slip(1.1, "a")});
    CHECK_FALSE(a.split);
    CHECK(a.swapped == 0);
    CHECK_FALSE(aligned({slip(0.9, "b"), slip(1.1, "a")}, {slip(1, "a"), slip(1, "b")}).split);
  }
  SUBCASE("of a given length") {
    const Events a = {slip(1, "a"), slip(1.01, "b")}, b = {slip(1, "b"), slip(1.01, "a")};
    CHECK(align(a, b, {10.0, 0.0}).split);
    CHECK_FALSE(align(a, b, {10.0, 0.02}).split);
  }
  SUBCASE("but one that is missing is missed") {
    const Alignment a = aligned({slip(1, "a"), slip(1, "b"), stick(2, "a")}, {slip(1, "b"), stick(2, "a")});
    REQUIRE(a.split);
    CHECK(a.split->t == 1.0);
    CHECK(a.split->reference == 0);
  }
}

TEST_CASE("alignment: an order closer than its uncertainty is swapped, not different") {
  const Events a = {slip(1.0, "a", 1e-6), slip(1.000001, "b", 1e-6), stick(2, "a")};
  const Events b = {slip(1.0, "b", 1e-6), slip(1.000001, "a", 1e-6), stick(2, "a")};
  const Alignment swapped = aligned(a, b);
  CHECK_FALSE(swapped.split);
  CHECK(swapped.swapped == 1);
  CHECK(swapped.pairs.size() == 3);
  CHECK(swapped.pairs[0].swapped);

  Events sure_a = a, sure_b = b;
  for (Events* list : {&sure_a, &sure_b})
    for (LoggedEvent& event : *list) event.uncertainty = 1e-9;
  CHECK(aligned(sure_a, sure_b).split);
  // One of the two lists does not know better: the other one may be right.
  CHECK_FALSE(aligned(sure_a, b).split);
  CHECK_FALSE(aligned(a, sure_b).split);
}

TEST_CASE("alignment: events of one contact are never swapped") {
  const Alignment a =
      aligned({slip(1, "a", 1.0), stick(1, "a", 1.0)}, {stick(1, "a", 1.0), slip(1, "a", 1.0)});
  CHECK(a.pairs.empty());
  CHECK(a.split);
}

TEST_CASE("alignment: load jumps take no part") {
  const Alignment a = aligned({load(0.5), slip(1, "a"), load(2)}, {slip(1, "a")});
  CHECK_FALSE(a.split);
  REQUIRE(a.pairs.size() == 1);
  CHECK(a.pairs[0].reference == 1);
}

TEST_CASE("alignment: only up to the common end, and what may lie beyond it is no difference") {
  const Events longer = {slip(1, "a"), stick(2, "a"), slip(3, "a")};
  CHECK_FALSE(aligned(longer, {slip(1, "a")}, 1.5).split);
  CHECK(aligned(longer, {slip(1, "a")}, 2.5).split);
  const Events at_end = {slip(1, "a"), stick(2 - 1e-7, "a", 1e-6)};
  CHECK_FALSE(aligned(at_end, {slip(1, "a")}, 2.0).split);
  CHECK_FALSE(aligned({slip(1, "a")}, at_end, 2.0).split);
}

TEST_SUITE_END();
