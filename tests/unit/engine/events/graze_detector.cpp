// Guards that come back into their tolerance and leave it: what is a graze, and what is not.
#include "engine/events/graze_detector.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>

using namespace signorini;

namespace {

constexpr double level_of_all = 1e-6;

/// Follows g(t) in steps of 0.1 of a method of order two; slot 1, beside one that nobody watches.
class ModalTangent {
 public:
  explicit ModalTangent(std::function<double(double)> g) : g_(std::move(g)) {
    decide::GuardStart idle, watched;
    watched.kind = Guard::sliding;
    grazes.start({idle, watched}, {0.0, level_of_all});
    fill(history_.restart(0.0), 0.0);
  }
  ModalTangent& to(double end, double limit = 1.0) {
    for (; t_ < end - 0.05; t_ += 0.1) {
      fill(history_.push(t_ + 0.1), t_ + 0.1);
      history_.prepare(std::min(++steps_, 2));
      grazes.update(history_, limit);
    }
    return *this;
  }
  events::GrazeDetector grazes;

 private:
  void fill(double* out, double t) const {
    out[0] = -1.0;
    out[1] = g_(t);
  }
  std::function<double(double)> g_;
  events::StepHistory history_ = events::StepHistory(2);
  double t_ = 0.0;
  int steps_ = 0;
};

}  // namespace

TEST_SUITE_BEGIN("unit/engine/events/graze_detector");

TEST_CASE("a guard that sinks back before it has clearly risen") {
  // 0.05 of the level at 0.2, lowest at 1, the level at 2.3
  const auto sunk = [](double depth) {
    return [=](double t) {
      return level_of_all * (t < 0.2 ? 0.25 * t : 0.05 - depth + depth * (t - 1.0) * (t - 1.0) / 0.64);
    };
  };
  ModalTangent dips(sunk(0.1));
  CHECK_FALSE(dips.to(1.5).grazes.first());  // it may still fall
  REQUIRE(dips.to(4.0).grazes.first());
  CHECK(dips.grazes.first()->t == doctest::Approx(1.0).epsilon(0.02));
  CHECK(dips.grazes.first()->slot == 1);
  CHECK(dips.grazes.first()->guard == Guard::sliding);
  CHECK_FALSE(ModalTangent(sunk(0.005)).to(20.0).grazes.first());  // less than a tenth of a tolerance
}

TEST_CASE("a guard that was high, comes down into its tolerance and goes up again") {
  const auto bowl = [](double low) {
    return [=](double t) { return low * level_of_all + 1e-3 * (t - 1.0) * (t - 1.0); };
  };
  CHECK(ModalTangent(bowl(0.5)).to(3.0).grazes.first());
  CHECK(ModalTangent(bowl(-0.5)).to(3.0).grazes.first());
  CHECK_FALSE(ModalTangent(bowl(1.5)).to(3.0).grazes.first());
  CHECK_FALSE(ModalTangent(bowl(0.5)).to(1.0).grazes.first());
}

TEST_CASE("a guard that rises from the rounding of its start does not graze, nor does one that falls") {
  CHECK_FALSE(ModalTangent([](double t) { return level_of_all * (t - 0.2); }).to(3.0).grazes.first());
  ModalTangent falls([](double t) { return 1e-3 * (1.0 - t); });
  falls.to(1.2).grazes.end({1});
  CHECK_FALSE(falls.grazes.first());
}

TEST_CASE(
    "what sank before it had risen is open when another guard ends the segment, not when it falls itself") {
  const auto g = [](double t) { return level_of_all * t * (0.3 - t); };
  ModalTangent other(g), itself(g), high([](double t) { return level_of_all * (2.0 - t); });
  other.to(0.5).grazes.end({0});
  REQUIRE(other.grazes.first());
  CHECK(other.grazes.first()->t == doctest::Approx(0.5));
  itself.to(0.5).grazes.end({1});
  CHECK_FALSE(itself.grazes.first());
  high.to(1.5).grazes.end({0});  // it was clearly high: the next segment sees its fall
  CHECK_FALSE(high.grazes.first());
  other.grazes.end({0});  // a segment without guards
  CHECK(other.grazes.first()->t == doctest::Approx(0.5));
}

TEST_CASE("of several the first counts, and nothing after an event inside a step") {
  ModalTangent twice([](double t) {
    return level_of_all * (1.0 + 9.0 * (t - 1.0) * (t - 1.0) * (t - 3.0) * (t - 3.0) - 0.5);
  });
  REQUIRE(twice.to(5.0).grazes.first());
  CHECK(twice.grazes.first()->t == doctest::Approx(1.0).epsilon(0.02));
  ModalTangent cut([](double t) { return 1e-3 * (0.05 - t) * (0.05 - t); });
  CHECK_FALSE(cut.to(0.1, 0.25).grazes.first());  // it rises after the event at 0.025
}
