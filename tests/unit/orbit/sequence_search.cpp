#include "orbit/sequence_search.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "signorini/event.hpp"

using namespace signorini;

namespace {

/// Places until the change at x* is held within `enough`. d: the stretch that vanishes; on which side of x* there is one.
int places(const std::function<double(double)>& d, double x_star, bool before, double enough) {
  const auto stretches = [&](double x) {
    if ((x < x_star) == before) return std::vector<double>{0.3, d(x), 0.7 - d(x)};
    return std::vector<double>{1.0};
  };
  orbit::SequenceSearch search(stretches(0.0), stretches(1.0), enough);
  int count = 0;
  for (; !search.done() && count < 100; ++count) {
    const double x = search.next();
    REQUIRE(x > search.low());
    REQUIRE(x < search.high());
    search.update(x, x < x_star, stretches(x));
  }
  CHECK(search.low() <= x_star);
  CHECK(search.high() >= x_star);
  CHECK(search.high() - search.low() <= enough);
  return count;
}

}  // namespace

TEST_SUITE_BEGIN("unit/orbit/sequence_search");

TEST_CASE("stretches between events, the last one into the next period") {
  std::vector<Event> events(3);
  events[0].t = 0.25;
  events[1].t = 0.5;
  events[2].t = 1.5;
  const std::vector<double> found = orbit::stretches_of(events, 2.0);
  REQUIRE(found.size() == 3);
  CHECK(found[0] == 0.125);
  CHECK(found[1] == 0.5);
  CHECK(found[2] == 0.375);
  CHECK(orbit::stretches_of({}, 2.0).empty());
}

TEST_CASE("a stretch that vanishes at a graze or at a crossing, before or behind the change") {
  for (const double x_star : {0.013, 0.37, 0.52, 0.9876})
    for (const bool before : {true, false}) {
      CAPTURE(x_star);
      CAPTURE(before);
      const auto from = [&](double x) { return std::abs(x - x_star); };
      const auto graze = [&](double x) { return 0.1 * std::sqrt(from(x)) * (1.0 + 0.6 * from(x)); };
      const auto crossing = [&](double x) { return 0.1 * from(x) * (1.0 - 0.6 * from(x)); };
      CHECK(places(graze, x_star, before, 1e-9) <= 18);  // halves: 30
      CHECK(places(crossing, x_star, before, 1e-9) <= 18);
    }
}

TEST_CASE("a stretch that jumps, or that nobody knows, is halved") {
  CHECK(places([](double) { return 0.2; }, 0.37, true, 1e-9) == 30);
  orbit::SequenceSearch search({}, {}, 1e-3);
  int count = 0;
  for (; !search.done(); ++count) {
    const double x = search.next();
    search.update(x, x < 0.7, {});
  }
  CHECK(count == 10);
}

TEST_SUITE_END();
