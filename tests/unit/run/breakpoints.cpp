#include "run/steering.hpp"

#include <doctest/doctest.h>

using namespace signorini;

TEST_SUITE_BEGIN("unit/run/breakpoints");

namespace {

Piece line(double origin, std::vector<double> coefficients) { return {origin, std::move(coefficients)}; }

Model with(const std::vector<History>& histories) {
  Model model;
  for (const History& h : histories) model.loads.push_back({"load", Combination{}, h, false});
  return model;
}

/// 0 before, 1 after.
History step(double start) { return {{start}, {Piece{}, line(0.0, {1.0})}}; }
/// 0 up to `start`, then with slope 1.
History ramp(double start) { return {{start}, {Piece{}, line(start, {0.0, 1.0})}}; }

}  // namespace

TEST_CASE("breakpoints: times that are one to the clock are one, and all histories are past it") {
  const double sum = 0.1 + 0.2;  // 0.30000000000000004
  REQUIRE(sum > 0.3);
  for (const auto& model : {with({step(0.3), ramp(sum)}), with({ramp(sum), step(0.3)})}) {
    const auto all = run::breakpoints(model, 1.0);
    REQUIRE(all.size() == 1);
    CHECK(all[0].time == sum);
    CHECK(all[0].jump);
  }
  const auto kinks = run::breakpoints(with({ramp(0.3), ramp(sum)}), 1.0);
  REQUIRE(kinks.size() == 1);
  CHECK_FALSE(kinks[0].jump);
}

TEST_CASE("breakpoints: what the clock can tell apart stays apart, from one to the next and not in chains") {
  const double clock = 0.5 * 100.0 * std::numeric_limits<double>::epsilon();
  CHECK(run::breakpoints(with({ramp(0.5), ramp(0.5 + 1.1 * clock)}), 1.0).size() == 2);
  const auto three =
      run::breakpoints(with({ramp(0.5), ramp(0.5 + 0.8 * clock), ramp(0.5 + 1.6 * clock)}), 1.0);
  REQUIRE(three.size() == 2);
  CHECK(three[0].time == 0.5 + 0.8 * clock);
  CHECK(three[1].time == 0.5 + 1.6 * clock);
}

TEST_CASE("breakpoints: a ramp that is over at once is a jump, one that comes back is none") {
  const double a = 0.85, b = 0.8500000000000111;
  const History up({a, b}, {line(0.0, {1.0}), line(a, {1.0, 2.0 / (b - a)}), line(0.0, {3.0})});
  const auto all = run::breakpoints(with({up}), 1.6);
  REQUIRE(all.size() == 1);
  CHECK(all[0].time == b);
  CHECK(all[0].jump);
  const History back({a, b}, {line(0.0, {1.0}), line(a, {1.0, 1.0}), line(0.0, {1.0})});
  const auto none = run::breakpoints(with({back}), 1.6);
  REQUIRE(none.size() == 1);
  CHECK_FALSE(none[0].jump);
}

TEST_CASE("breakpoints: those of the run alone, in order") {
  const auto all = run::breakpoints(with({step(1.0), step(0.25), step(0.0), step(-1.0), step(0.75)}), 1.0);
  REQUIRE(all.size() == 2);
  CHECK(all[0].time == 0.25);
  CHECK(all[1].time == 0.75);
}

TEST_SUITE_END();
