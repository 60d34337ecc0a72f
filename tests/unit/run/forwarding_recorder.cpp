#include "run/forwarding_recorder.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace signorini::tests::relays {
namespace {

/// Writes down what it is told.
struct Told : Recorder {
  std::string calls;
  bool go_on = true;
  void event(const Event& /*event*/) override { calls += "event "; }
  void sample(const Sample& /*sample*/) override { calls += "sample "; }
  void frame(const Sample& /*sample*/) override { calls += "frame "; }
  [[nodiscard]] bool wants_motion() const override { return true; }
  void motion(int contact, const std::vector<MotionRow>& /*rows*/) override {
    calls += "motion" + std::to_string(contact) + " ";
  }
  void curves(const Curves& /*curves*/) override { calls += "curves "; }
  void response(double /*t*/, const std::vector<double>& /*values*/) override { calls += "response "; }
  [[nodiscard]] bool wants_instants() const override { return true; }
  void instant(const InstantRow& /*instant*/) override { calls += "instant "; }
  [[nodiscard]] bool steers() const override { return true; }
  bool steer(const Sample& /*now*/, Steering& /*run*/) override {
    calls += "steer ";
    return go_on;
  }
  bool progress(double /*t*/) override { return go_on; }
};

struct NoLoads : Steering {
  void set_load(const std::string& /*name*/, const History& /*history*/) override {}
};

}  // namespace

TEST_SUITE_BEGIN("unit/run/forwarding_recorder");

TEST_CASE("everything that a run tells reaches the recorder behind") {
  Told told;
  run::ForwardingRecorder relay(&told);
  NoLoads loads;
  relay.event({});
  relay.sample({});
  relay.frame({});
  relay.motion(2, {});
  relay.curves({});
  relay.response(0.0, {});
  relay.instant({});
  CHECK(relay.steer({}, loads));
  CHECK(told.calls == "event sample frame motion2 curves response instant steer ");
  CHECK(relay.wants_motion());
  CHECK(relay.wants_instants());
  CHECK(relay.steers());
  told.go_on = false;
  CHECK_FALSE(relay.progress(0.0));
  CHECK_FALSE(relay.steer({}, loads));
}

TEST_CASE("it has come as far as the last event, row or step; alone it wants nothing and goes on") {
  run::ForwardingRecorder relay;
  Event event;
  event.t = 0.25;
  relay.event(event);
  CHECK(relay.reached() == 0.25);
  Sample sample;
  sample.t = 0.5;
  relay.sample(sample);
  CHECK(relay.reached() == 0.5);
  CHECK(relay.progress(0.75));
  CHECK(relay.reached() == 0.75);
  CHECK_FALSE(relay.wants_motion());
  CHECK_FALSE(relay.wants_instants());
  CHECK_FALSE(relay.steers());
}

TEST_SUITE_END();

}  // namespace signorini::tests::relays
