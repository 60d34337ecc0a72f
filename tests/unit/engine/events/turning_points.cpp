#include "engine/events/turning_points.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace signorini;

namespace {

/// A step from t = 1 of length 2 on which N has the given coefficients and all else stands still.
struct OneForce {
  motion::Series series;
  std::vector<motion::ContactSeries> contacts{1};
  events::TurningPointDetector turns{1};

  explicit OneForce(const std::vector<double>& N) {
    const std::size_t degree = N.size() - 1;
    series.t = 1.0;
    series.scale = 2.0;
    series.u = Eigen::MatrixXd::Zero(1, static_cast<Eigen::Index>(degree + 3));
    series.layout = ForceLayout(1);
    series.forces = Eigen::MatrixXd::Zero(2, static_cast<Eigen::Index>(degree + 1));
    for (std::size_t k = 0; k <= degree; ++k) series.forces(0, static_cast<Eigen::Index>(k)) = N[k];
    series.forcing.count = degree + 3;
    series.forcing.surface.assign(degree + 3, 0.0);
    series.forcing.applied_normal_force = series.forcing.surface;
    contacts[0].fill(Contact{}, 0, series, degree);
    decide::Decision decision;
    ContactMotion m;
    m.N = N[0];
    decision.after = decision.before = {m};
    decision.slides_after.resize(1);
    turns.start(decision);
  }
  const std::vector<double>& times() {
    turns.find(contacts, series, 0.0, 1.0);
    return turns.times();
  }
};

}  // namespace

TEST_SUITE_BEGIN("unit/engine/events/turning_points");

TEST_CASE("a peak between the ends of a step is found where it is, whatever the sign of the value") {
  for (const double level : {0.0, -50.0, 50.0}) {
    CAPTURE(level);
    OneForce peak({level - 3.0 * 0.37 * 0.37, 6.0 * 0.37, -3.0});  // level - 3 (x - 0.37)^2
    REQUIRE(peak.times().size() == 1);
    CHECK(peak.turns.times()[0] == doctest::Approx(1.0 + 2.0 * 0.37).epsilon(1e-12));
  }
}

TEST_CASE("what turns within all that was before is no extreme, nor is the end of a slope") {
  OneForce slope({1.0, 2.0, -0.5});
  CHECK(slope.times().empty());
  OneForce again({3.0 - 3.0 * 0.37 * 0.37, 6.0 * 0.37, -3.0});
  REQUIRE(again.times().size() == 1);
  again.series.forces *= 0.5;  // a lower peak on a later step
  again.contacts[0].fill(Contact{}, 0, again.series, 2);
  CHECK(again.times().empty());
}

TEST_CASE("a peak beside an end of a step is found, though all samples go one way") {
  // Nearer to 1 the peak exceeds the end, by 3 (1 - at)^2, by no more than the rounding of three terms of size 3.
  for (const double at : {1e-9, 0.003, 0.05, 0.11, 0.89, 0.95, 0.997, 1.0 - 1e-6}) {
    CAPTURE(at);
    OneForce peak({-3.0 * at * at, 6.0 * at, -3.0});  // -3 (x - at)^2
    REQUIRE(peak.times().size() == 1);
    CHECK(peak.turns.times()[0] == doctest::Approx(1.0 + 2.0 * at).epsilon(1e-12));
  }
  OneForce falling({1.0, -2.0, -0.5});
  CHECK(falling.times().empty());
  OneForce resting({1.0, 0.0, 0.5});
  CHECK(resting.times().empty());
}

TEST_CASE(
    "a peak beside an end where it turns the other way: after a hit that stops a slip it rises from there at "
    "first") {
  const double rise = 0.01,
               at = std::sqrt(0.5 * rise);  // rise x^2 - x^4, less at a sample's distance of 1/8 than at 0
  OneForce from({1.0, 0.0, rise, 0.0, -1.0});
  REQUIRE(from.times().size() == 1);
  CHECK(from.turns.times()[0] == doctest::Approx(1.0 + 2.0 * at).epsilon(1e-9));
  OneForce to({rise - 1.0, 4.0 - 2.0 * rise, rise - 6.0, 4.0, -1.0});  // the same of 1 - x
  REQUIRE(to.times().size() == 1);
  CHECK(to.turns.times()[0] == doctest::Approx(1.0 + 2.0 * (1.0 - at)).epsilon(1e-9));
}

TEST_CASE("a part of a step that begins at a peak has it, for nobody looks there") {
  OneForce rising({0.0, 1.0});
  rising.turns.find(rising.contacts, rising.series, 0.0, 1.0, events::TurningPointDetector::Ends::part);
  CHECK(rising.turns.times().empty());
  for (const double slope : {-1e-3, 0.0, 1e-3}) {  // the peak was a little before, or is a little after
    CAPTURE(slope);
    OneForce peak({0.0, slope, -1.0});
    peak.series.forces(0, 0) = 1.0;
    peak.contacts[0].fill(Contact{}, 0, peak.series, 2);
    peak.turns.find(peak.contacts, peak.series, 0.0, 1.0, events::TurningPointDetector::Ends::part);
    REQUIRE(peak.turns.times().size() == 1);
    CHECK(peak.turns.times()[0] == doctest::Approx(1.0 + std::max(0.0, slope)).epsilon(1e-12));
  }
}

TEST_CASE("what only seems to exceed all before is no turn: it would stand for the last one of its kind") {
  // Through the samples about its vertex the parabola rises to 0.98; a tenth more of that is more than the 1 of before.
  OneForce high({1.0 - 3.0 * 0.41 * 0.41, 6.0 * 0.41, -3.0});
  REQUIRE(high.times().size() == 1);
  for (const double level : {0.9999, 0.999, 0.99, 0.98})
    for (const double sharp : {3.0, 30.0, 300.0}) {
      CAPTURE(level);
      CAPTURE(sharp);
      OneForce lower({1.0 - 3.0 * 0.41 * 0.41, 6.0 * 0.41, -3.0});
      REQUIRE(lower.times().size() == 1);
      const double at = 0.4375;  // between two samples
      for (int k = 0; k < 3; ++k)
        lower.series.forces(0, k) = std::vector<double>{level - sharp * at * at, 2.0 * sharp * at,
                                                        -sharp}[static_cast<std::size_t>(k)];
      lower.turns.find_at_start(0, motion::ContactSeries::N, -1e9, 0.0, 0.0);  // lower than all that comes
      lower.contacts[0].fill(Contact{}, 0, lower.series, 2);
      CHECK(lower.times().empty());
    }
}

TEST_CASE("a peak between two parts of a step is the beginning of the second, and one there alone") {
  for (const double sign : {1.0, -1.0}) {
    CAPTURE(sign);
    OneForce rising({0.0, sign});
    rising.turns.find(rising.contacts, rising.series, 0.0, 1.0,
                      events::TurningPointDetector::Ends::first_part);
    CHECK(rising.turns.times().empty());
    events::TurningPointDetector& turns = rising.turns;
    CHECK_FALSE(turns.find_at_start(0, motion::ContactSeries::N, sign, 0.5 * sign, 3.0));  // it rises on
    const auto peak = turns.find_at_start(0, motion::ContactSeries::N, sign, -0.5 * sign, 3.0);
    REQUIRE(peak);
    CHECK(peak->time == 3.0);
    CHECK_FALSE(
        turns.find_at_start(0, motion::ContactSeries::N, sign, -0.5 * sign, 5.0));  // as high as before
    CHECK_FALSE(turns.find_at_start(0, motion::ContactSeries::N, 0.5 * sign, -0.5 * sign, 5.0));  // lower
  }
}

TEST_CASE("a step that is a part of its series, about an origin of its own, turns where the series does") {
  const std::vector<double> N{-3.0 * 0.37 * 0.37, 6.0 * 0.37, -3.0};  // -3 (x - 0.37)^2
  for (const double origin : {0.0, 0.2}) {
    CAPTURE(origin);
    const double turn = 1.0 + 2.0 * (origin + 0.37);
    OneForce before(N), over(N), after(N);
    for (OneForce* peak : {&before, &over, &after}) peak->contacts[0].set_origin(origin);
    before.turns.find(before.contacts, before.series, origin, origin + 0.3);
    CHECK(before.turns.times().empty());
    over.turns.find(over.contacts, over.series, origin + 0.3, origin + 0.9);
    REQUIRE(over.turns.times().size() == 1);
    CHECK(over.turns.times()[0] == doctest::Approx(turn).epsilon(1e-12));
    after.turns.find(after.contacts, after.series, origin + 0.5, origin + 0.9);
    CHECK(std::none_of(after.turns.times().begin(), after.turns.times().end(),
                       [&](double t) { return std::abs(t - turn) < 0.1; }));
  }
}

TEST_CASE("what its rate keeps within all that was before is not looked at, and what leaves it is found") {
  // From 0 up to 2 at x = 1; then, after an instant, a bow of height `rise` over the value 1 that it begins with.
  for (const double rise : {0.5, 0.99, 1.3}) {
    CAPTURE(rise);
    OneForce path({0.0, 2.0, 0.0});
    CHECK(path.times().empty());
    decide::Decision decision;
    ContactMotion m;
    m.N = 1.0;
    decision.after = decision.before = {m};
    decision.slides_after.resize(1);
    path.turns.start(decision);
    path.series.forces << 1.0, 4.0 * rise, -4.0 * rise, 0.0, 0.0, 0.0;
    path.contacts[0].fill(Contact{}, 0, path.series, 2);
    path.contacts[0].bound_rates(1.0);
    path.turns.find(path.contacts, path.series, 0.0, 1.0);
    if (rise < 1.0) {
      CHECK(path.turns.times().empty());
    } else {
      REQUIRE(path.turns.times().size() == 1);
      CHECK(path.turns.times()[0] == doctest::Approx(2.0));
    }
  }
}

TEST_CASE("a value beyond all before has turned where it goes back, unless it is beyond by its rounding") {
  const events::TurningPointDetector::Range range{-2.0, 3.0};
  CHECK(range.is_exceeded(3.5, -1e-20, 0.0));
  CHECK(range.is_exceeded(-2.5, 1e-20, 0.4));
  CHECK_FALSE(range.is_exceeded(3.5, 1.0, 0.0));  // it goes on
  CHECK_FALSE(range.is_exceeded(3.5, 0.0, 0.0));
  CHECK_FALSE(range.is_exceeded(-2.5, -1.0, 0.0));
  CHECK_FALSE(range.is_exceeded(3.0, -1.0, 0.0));  // as far as before
  CHECK_FALSE(range.is_exceeded(-2.0, 1.0, 0.0));
  CHECK_FALSE(range.is_exceeded(3.5, -1.0, 0.6));
  CHECK_FALSE(range.is_exceeded(-2.5, 1.0, 0.6));
  CHECK(range.width(0.0) == 5.0);
  CHECK(range.width(4.0) == 6.0);
  CHECK(range.width(-4.0) == 7.0);
}

TEST_SUITE_END();
