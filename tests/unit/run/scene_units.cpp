#include "run/scene_units.hpp"

#include <doctest/doctest.h>

#include "scene/quantities.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/run/scene_units");

TEST_CASE("physical: every column of an event goes by the unit that its table names") {
  const Factors of{2.0, 3.0, 5.0};
  Event event;
  event.t = event.N = event.T_after = event.vn = event.vt_after = 1.0;
  event.gap = event.impulse_n = event.t_uncertainty = event.guard_rate = 1.0;
  const Event seen = run::to_scene_units(event, of);
  CHECK(seen.t == 5.0);
  CHECK(seen.gap == 3.0);
  CHECK(seen.N == 2.0);
  CHECK(seen.T_after == 2.0);
  CHECK(seen.vn == doctest::Approx(0.6));
  CHECK(seen.vt_after == doctest::Approx(0.6));
  CHECK(seen.impulse_n == 10.0);
  CHECK(seen.t_uncertainty == 5.0);
  CHECK(seen.guard_rate == 1.0);  // has the guard's unit, which the log knows
  CHECK_FALSE(seen.impulse_t);
}

TEST_CASE("physical: no column with a number has a unit that is not brought to the scene's") {
  for (const EventColumn& column : event_columns) {
    Event event;
    if (const auto* number = std::get_if<double Event::*>(&column.field))
      event.** number = 1.0;
    else if (const auto* optional = std::get_if<std::optional<double> Event::*>(&column.field))
      event.** optional = 1.0;
    else
      continue;
    const Event seen = run::to_scene_units(event, {2.0, 3.0, 5.0});
    const auto value_of = [&](const Event& e) {
      if (const auto* number = std::get_if<double Event::*>(&column.field)) return e.**number;
      return *(e.*std::get<std::optional<double> Event::*>(column.field));
    };
    INFO(column.name);
    const bool by_guard = std::string(column.name) == event_column(&Event::guard_rate);
    CHECK((value_of(seen) == 1.0) == by_guard);
  }
}

TEST_SUITE_END();
