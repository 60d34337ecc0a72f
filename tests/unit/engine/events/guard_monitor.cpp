#include "engine/events/active_guards.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace signorini;

namespace {

/// Steps of size h on one guard g(t), degree of the method as IDA raises it; the falls found.
std::vector<double> falls(const std::function<double(double)>& g, bool at_zero, double level, double h,
                          int steps) {
  decide::GuardStart start;
  start.kind = Guard::separation;
  start.at_zero = at_zero;
  events::GuardMonitor watch;
  watch.start({start}, decide::GuardForms(1), {level}, ForceLayout(1));
  events::StepHistory history(1);
  *history.restart(0.0) = g(0.0);
  std::vector<double> found;
  for (int i = 1; i <= steps; ++i) {
    *history.push(i * h) = g(i * h);
    history.prepare(std::min(i, 5));
    for (const events::ZeroCrossing& fall : watch.check(history, 1.0))
      found.push_back(history.begin() + fall.x * h);
  }
  return found;
}

}  // namespace

TEST_SUITE_BEGIN("unit/engine/events/guard_monitor");

TEST_CASE("a fall and rise inside one step is found, though both ends are positive") {
  // below zero from 0.52 to 0.58, steps end at multiples of 0.1... but 0.5 and 0.6 are positive
  const auto found = falls([](double t) { return (t - 0.52) * (t - 0.58); }, false, 1e-9, 0.1, 8);
  REQUIRE(found.size() == 1);
  CHECK(found[0] == doctest::Approx(0.52).epsilon(1e-9));
}

TEST_CASE("an event is late by the level of a guard that has not risen, and of no other") {
  decide::GuardStart at_zero, clear, idle;
  at_zero.kind = clear.kind = Guard::separation;
  at_zero.at_zero = true;
  const ForceLayout layout({{1, 2, 0, 2}, {1, 3, 0, 1}});  // slots 0 to 3 and 4 to 7
  std::vector<decide::GuardStart> guards(layout.guard_count(), idle);
  guards[4] = at_zero;
  guards[5] = clear;
  decide::GuardsOfState of_second;
  of_second[0].form.N = -1.0;
  of_second[1].form.T = 1.0;
  decide::GuardForms forms(2);
  forms.set(1, of_second);
  events::GuardMonitor watch;
  CHECK(watch.allowed_depth(1, of_second[0]) == 0.0);  // before any segment
  watch.start(guards, forms, std::vector<double>(guards.size(), 1e-6), layout);
  CHECK(watch.allowed_depth(1, of_second[0]) == 1e-6);
  CHECK(watch.allowed_depth(0, of_second[0]) == 0.0);
  CHECK(watch.allowed_depth(1, of_second[1]) == 0.0);
  events::StepHistory history(guards.size());
  double* start = history.restart(0.0);
  std::fill_n(start, guards.size(), 1.0);
  start[4] = 0.0;
  std::fill_n(history.push(1.0), guards.size(), 1.0);  // rises above its level
  history.prepare(1);
  CHECK(watch.check(history, 1.0).empty());
  CHECK(watch.allowed_depth(1, of_second[0]) == 0.0);
}

TEST_CASE("a guard that starts at zero and rises fires only after it has clearly risen") {
  const double level = 1e-6;
  SUBCASE("noise below the level is not an event") {
    const auto noisy = [](double t) { return t * t + 1e-7 * std::sin(1e5 * t); };
    CHECK(falls(noisy, true, level, 0.01, 20).empty());
  }
  SUBCASE("rise and fall is one event") {
    const auto found = falls([](double t) { return t * t * (0.105 - t); }, true, level, 0.01, 11);
    REQUIRE(found.size() == 1);
    CHECK(found[0] == doctest::Approx(0.105).epsilon(1e-6));
  }
  SUBCASE("rise and fall inside the very step that arms it") {
    const auto found = falls([](double t) { return t * (0.2 - t) * (1.0 + 0.1 * t); }, true, level, 0.25, 3);
    REQUIRE_FALSE(found.empty());
    // the first step is of order one and sees only the fall; its ends decide
    CHECK(found[0] <= 0.25);
  }
  SUBCASE("leaving on the wrong side is an event: the state was wrong") {
    const auto found = falls([](double t) { return -t; }, true, level, 0.01, 2);
    REQUIRE_FALSE(found.empty());
    CHECK(found[0] == doctest::Approx(level).epsilon(1e-6));
  }
}

TEST_CASE("idle guards never fall") {
  events::GuardMonitor watch;
  watch.start({decide::GuardStart{}}, decide::GuardForms(1), {1.0}, ForceLayout(1));
  events::StepHistory history(1);
  *history.restart(0.0) = 1.0;
  *history.push(1.0) = -1.0;
  history.prepare(1);
  CHECK(watch.check(history, 1.0).empty());
}

TEST_CASE("what was taken not to fall waits: deeper it falls, and once it has risen it counts as before") {
  const auto found = [](const std::function<double(double)>& g) {
    decide::GuardStart clear;
    clear.kind = Guard::sliding;
    events::GuardMonitor watch;
    watch.start({clear}, decide::GuardForms(1), {1e-9}, ForceLayout(1));
    events::StepHistory history(1);
    *history.restart(0.0) = g(0.0);
    std::vector<double> result;
    for (int i = 1; i <= 40; ++i) {
      *history.push(0.05 * i, 0.05) = g(0.05 * i);
      history.prepare(std::min(i, 5));
      for (const events::ZeroCrossing& fall : watch.check(history, 1.0)) {
        result.push_back(history.begin() + fall.x * 0.05);
        if (result.size() == 1) watch.set_waiting(0, 1e-3);
      }
    }
    return result;
  };
  // Touches zero at 1 to 1e-4 and rises: one fall, waited out.
  CHECK(found([](double t) { return (t - 1.0) * (t - 1.0) - 1e-4; }).size() == 1);
  // Goes on sinking: an event where it is 1e-3 below.
  const auto sinks = found([](double t) { return 0.01 * (1.0 - t); });
  REQUIRE(sinks.size() >= 2);
  CHECK(sinks[1] == doctest::Approx(1.1).epsilon(1e-9));
}

TEST_SUITE_END();
