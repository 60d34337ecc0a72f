#include "engine/watch.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

using namespace signorini;

namespace {

/// Steps of size h on one guard g(t), degree of the method as IDA raises it; the falls found.
std::vector<double> falls(const std::function<double(double)>& g, bool at_zero, double level, double h,
                          int steps) {
  GuardStart start;
  start.kind = Guard::separation;
  start.at_zero = at_zero;
  Watch watch;
  watch.start({start}, {level});
  StepHistory history(1);
  *history.restart(0.0) = g(0.0);
  std::vector<double> found;
  for (int i = 1; i <= steps; ++i) {
    *history.push(i * h) = g(i * h);
    history.prepare(std::min(i, 5));
    for (const Fall& fall : watch.check(history, 1.0)) found.push_back(history.begin() + fall.x * h);
  }
  return found;
}

}  // namespace

TEST_SUITE_BEGIN("unit/watch");

TEST_CASE("a fall and rise inside one step is found, though both ends are positive") {
  // below zero from 0.52 to 0.58, steps end at multiples of 0.1... but 0.5 and 0.6 are positive
  const auto found = falls([](double t) { return (t - 0.52) * (t - 0.58); }, false, 1e-9, 0.1, 8);
  REQUIRE(found.size() == 1);
  CHECK(found[0] == doctest::Approx(0.52).epsilon(1e-9));
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
  Watch watch;
  watch.start({GuardStart{}}, {1.0});
  StepHistory history(1);
  *history.restart(0.0) = 1.0;
  *history.push(1.0) = -1.0;
  history.prepare(1);
  CHECK(watch.check(history, 1.0).empty());
}

TEST_SUITE_END();
