// Gaps that come near to zero and open again.
#include "engine/events/graze_detector.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace signorini;

namespace {

constexpr double level_of_gap = 1e-6;

/// What is seen of a gap in steps of 0.1 of a method of order three: that of the second contact.
std::vector<events::NearHit> near_hits_of(const std::function<double(double)>& gap, double end,
                                          double limit = 1.0) {
  const ForceLayout layout({{1, 2, 0, 3}, {1, 3, 0, 1}});  // slot 5
  std::vector<decide::GuardStart> guards(layout.guard_count());
  std::vector<double> levels(guards.size(), level_of_gap);
  guards[layout.guard(1)].kind = Guard::closing;
  events::StepHistory history(guards.size());
  const auto fill = [&](double* out, double t) {
    std::fill_n(out, guards.size(), 1.0);
    out[layout.guard(1)] = gap(t);
  };
  events::NearHitDetector hits;
  hits.start(guards, levels, layout);
  fill(history.restart(0.0), 0.0);
  int steps = 0;
  for (double t = 0.1; t < end; t += 0.1) {
    fill(history.push(t, 0.1), t);
    history.prepare(std::min(++steps, 3));
    hits.update(history, limit);
  }
  return hits.list();
}

}  // namespace

TEST_SUITE_BEGIN("unit/engine/events/near_hits");

TEST_CASE("each least gap below ten thousand levels, with its time and its value") {
  // 1e4 levels are 1e-2
  const auto swings = [](double least) {
    return [least](double t) { return least + 0.1 * (1.0 + std::cos(2.0 * t - 1.0)); };
  };
  const std::vector<events::NearHit> hits = near_hits_of(swings(5e-3), 6.0);
  REQUIRE(hits.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(hits[i].contact == 1);
    CHECK(hits[i].t ==
          doctest::Approx((1.0 + (2.0 * static_cast<double>(i) + 1.0) * M_PI) / 2.0).epsilon(1e-4));
    CHECK(hits[i].gap == doctest::Approx(5e-3).epsilon(1e-3));
  }
  CHECK(near_hits_of(swings(1.1e-2), 6.0).empty());
  REQUIRE(near_hits_of(swings(-1e-7), 6.0).size() == 2);  // what an error has let fall
  CHECK(near_hits_of(swings(-1e-7), 6.0)[0].gap < 2e-5);
  CHECK(near_hits_of(swings(-1e-3), 6.0)[0].gap == 0.0);
}

TEST_CASE("a least gap where two steps meet is one, looked at once") {
  for (const double meeting : {1.0, 1.1, 1.7}) {
    CAPTURE(meeting);
    const std::vector<events::NearHit> hits = near_hits_of(
        [&](double t) { return 5e-3 + 0.1 * (1.0 - std::cos(2.0 * (t - meeting))); }, meeting + 1.0);
    REQUIRE(hits.size() == 1);
    CHECK(std::abs(hits[0].t - meeting) < 1e-3);  // h^3 g''''/(4 g''): of the history
    CHECK(hits[0].gap == doctest::Approx(5e-3).epsilon(1e-3));
  }
}

TEST_CASE("what touches and trembles by less than a level is none, and neither is what opens") {
  CHECK(near_hits_of([](double t) { return 0.4 * level_of_gap * (1.0 + std::sin(9.0 * t)); }, 5.0).empty());
  CHECK(near_hits_of([](double t) { return 0.3 * t * t; }, 5.0).empty());
  CHECK(near_hits_of([](double t) { return 1.0 / (1.0 + t * t * t * t * 100.0); }, 5.0).empty());
}

TEST_SUITE_END();
