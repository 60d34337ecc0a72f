#include "run/event_log.hpp"

#include <doctest/doctest.h>

using namespace signorini;

TEST_SUITE_BEGIN("unit/run/event_log");

TEST_CASE("event log: every change of state has its type") {
  using enum State;
  CHECK(run::classify(stick, open, false) == EventType::separation);
  CHECK(run::classify(slip_minus, open, false) == EventType::separation);
  CHECK(run::classify(open, stick, false) == EventType::contact);
  CHECK(run::classify(open, closed, false) == EventType::contact);
  CHECK(run::classify(stick, slip_plus, false) == EventType::slip);
  CHECK(run::classify(slip_minus, stick, false) == EventType::stick);
  CHECK(run::classify(slip_plus, slip_minus, false) == EventType::reversal);
  CHECK(run::classify(slip_minus, slip_plus, false) == EventType::reversal);
  CHECK(run::classify(slip_minus, closed, false) == EventType::stick);
  CHECK(run::classify(closed, slip_minus, false) == EventType::slip);
  // Of a law of one's own: hold that changes its rows lets go of the old ones.
  CHECK(run::classify(stick, closed, false) == EventType::slip);
  CHECK_FALSE(run::classify(stick, stick, false));
  CHECK(run::classify(stick, stick, true) == EventType::slip);
}

TEST_CASE("event log: a guard that falls steeply is sharp, one that grazes is not") {
  decide::Crossing crossing;
  crossing.derivatives = {-4.0, 0.0, 0.0, 0.0};
  CHECK(run::time_uncertainty(crossing, 1e-8) == doctest::Approx(2.5e-9));
  crossing.derivatives = {0.0, -2.0, 0.0, 0.0};  // g = -t^2: off by sqrt(error)
  CHECK(run::time_uncertainty(crossing, 1e-8) == doctest::Approx(1e-4));
  crossing.derivatives = {-1e-6, -2.0, 0.0, 0.0};  // the sharper of the two
  CHECK(run::time_uncertainty(crossing, 1e-8) == doctest::Approx(1e-4));
  crossing.derivatives = {0.0, 0.0, 0.0, 0.0};
  CHECK_FALSE(run::time_uncertainty(crossing, 1e-8));
}

TEST_CASE("event log: rows of types stand where to_string looks for them") {
  for (std::size_t i = 0; i < all_event_types.size(); ++i)
    CHECK(static_cast<std::size_t>(all_event_types[i].type) == i);
}

TEST_SUITE_END();
