// Runs that end at the time of one of their events, and others that go on from there: together they have the events of one
// run, each once.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "behaviour/halves.hpp"
#include "own_folder.hpp"
#include "result/run_directory.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::going_on_at_events {
namespace {

/// How many events each contact has.
using EventCount = std::map<int, std::size_t>;

void count_events(const std::vector<Event>& events, EventCount& count) {
  for (const Event& e : events)
    if (e.type != EventType::time) ++count[e.contact];
}

/// Splits the run of a scene file, to t_end, at each of its events.
void check_splits_at_events(const std::string& file, const char* engine, double t_end) {
  CAPTURE(file);
  CAPTURE(engine);
  Scene scene = read_scene(file, {{"run.engine", engine}});
  scene.run.t_end = t_end;
  const Result whole = simulate(build_model(scene), scene.run);
  EventCount expected;
  count_events(whole.events, expected);
  REQUIRE(!expected.empty());
  for (const Event& event : whole.events) {
    const double t = event.t;
    CAPTURE(t);
    const OwnFolder own;
    const auto folder = own.path() / "first";
    Scene first = read_scene(file, {{"run.engine", engine}});
    first.run.t_end = t;
    first.run.output_dt.reset();
    first.run.output_times.reset();
    first.run.frames.clear();
    const Model model = build_model(first);
    halves::Kept kept(folder, first, model);
    kept.report = simulate(model, first.run, kept);
    kept.finish();
    Scene second = read_scene(
        file, {{"run.engine", engine}, {"run.initial", fmt::format("{{ run = \"{}\" }}", folder.string())}});
    halves::shift(second, t);
    second.run.t_end = t_end - t;
    second.run.output_dt.reset();
    second.run.output_times.reset();
    second.run.frames.clear();
    const Result rest = simulate(build_model(second), second.run);
    INFO(rest.report.outcome.reason);
    CHECK(rest.report.outcome.kind == Outcome::Kind::done);
    CHECK(rest.report.law_checks.violations.empty());
    EventCount found;
    count_events(kept.events, found);
    count_events(rest.events, found);
    CHECK(found == expected);
  }
}

/// Continues from the states that the whole run saves at its events: just after them, so that only later events follow.
void check_later_events(const std::string& file, const std::string& engine) {
  CAPTURE(file);
  Scene scene = read_scene(file, {{"run.engine", engine}});
  const double t_end = scene.run.t_end;
  const Model model = build_model(scene);
  const Result first = simulate(model, scene.run);
  REQUIRE(first.events.size() > 5);
  for (const Event& event : first.events) scene.run.frames.push_back(event.t);
  const OwnFolder own;
  const auto folder = own.path() / "whole";
  halves::Kept kept(folder, scene, model);
  kept.report = simulate(model, scene.run, kept);
  kept.finish();
  for (std::size_t i = 0; i < first.events.size(); ++i) {
    const double t = first.events[i].t;
    CAPTURE(t);
    Scene second = read_scene(
        file, {{"run.engine", engine},
               {"run.initial", fmt::format("{{ run = \"{}\", t = {:.17g} }}", folder.string(), t)}});
    halves::shift(second, t);
    second.run.t_end = t_end - t;
    const Result rest = simulate(build_model(second), second.run);
    CHECK(rest.report.law_checks.violations.empty());
    REQUIRE(rest.events.size() == first.events.size() - i - 1);
    for (std::size_t j = 0; j < rest.events.size(); ++j) {
      CHECK(rest.events[j].to == first.events[i + 1 + j].to);
      CHECK(std::abs(rest.events[j].t + t - first.events[i + 1 + j].t) < 1e-6 * t_end);
    }
  }
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/rounding/going_on_at_events");

TEST_CASE("a block that rocks goes on from each of its events") {
  check_splits_at_events(SIGNORINI_MODELS "/rocking.toml", "exact", 0.98);
}

TEST_CASE("a frame that lifts off and lands has each event once") {
  for (const char* engine : {"ida", "exact"})
    check_splits_at_events(SIGNORINI_MODELS "/lift-off.toml", engine, 1.5);
}

TEST_CASE("a pad that yields and lets go has each event once") {
  check_splits_at_events(SIGNORINI_TEST_DATA "/scenes/continued/yielding-pad.toml", "ida", 1.2);
  check_later_events(SIGNORINI_TEST_DATA "/scenes/continued/yielding-pad.toml", "ida");
}

TEST_CASE("a shaken block whose foot hits at the split, while the other lets go: both are events, once") {
  check_splits_at_events(SIGNORINI_TEST_DATA "/scenes/continued/rocking-shaken.toml", "ida", 1.7);
}

TEST_SUITE_END();
}  // namespace signorini::tests::going_on_at_events
