#include <doctest/doctest.h>

#include "signorini/error.hpp"
#include "study/speed/pareto_front.hpp"
#include "study/speed/work_plan.hpp"

using namespace signorini;

namespace {

speed::WorkRow row(const std::string& engine, double accuracy, double error, double seconds) {
  speed::WorkRow r;
  r.point.engine = engine;
  if (!speed::accuracy_key(engine).empty()) r.point.accuracy = accuracy;
  r.outcome = "done";
  r.whole = true;
  r.errors = {{"event_time", "s", error, 0.0, "", error}};
  r.wall_times = {2.0 * seconds, seconds};
  return r;
}

}  // namespace

TEST_SUITE_BEGIN("unit/study/speed/work_study");

TEST_CASE("decades: ranges, factors, lists, and what is none") {
  CHECK(speed::parse_decades("--rtol", "1e-4:1e-7") == std::vector<double>{1e-4, 1e-5, 1e-6, 1e-7});
  CHECK(speed::parse_decades("--rtol", "1e-7:1e-4:1000") == std::vector<double>{1e-7, 1e-4});
  CHECK(speed::parse_decades("--dt", "1e-2:1e-3:2") == std::vector<double>{1e-2, 5e-3, 2.5e-3, 1.25e-3});
  CHECK(speed::parse_decades("--dt", "3e-3,1e-3") == std::vector<double>{3e-3, 1e-3});
  CHECK(speed::parse_decades("--dt", "0.5") == std::vector<double>{0.5});
  for (const char* wrong :
       {"", "0", "-1:2", "1:x", "1:2:1", "1:2:3:4", "1e-3,1e-3", "1:nan", "1:1e-200:1.01"}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS((void)speed::parse_decades("--dt", wrong), UsageError);
  }
}

TEST_CASE("work plan: each engine by what says how accurate it is") {
  speed::WorkRanges ranges;
  ranges.engines = {"exact", "ida", "newmark"};
  ranges.rtol = {1e-6, 1e-8};
  ranges.dt = {1e-3};
  std::vector<std::string> names;
  for (const speed::WorkPoint& point : speed::work_points(ranges)) names.push_back(point.name());
  CHECK(names == std::vector<std::string>{"exact", "ida rtol=1e-06", "ida rtol=1e-08", "newmark dt=0.001"});

  ranges.varied = {{{"a.b", "1"}}, {{"a.b", "2"}}};
  const std::vector<speed::WorkPoint> points = speed::work_points(ranges);
  CHECK(points.size() == 8);
  CHECK(points[0].name() == "exact a.b=1");
  CHECK(points[2].line() == "ida a.b=1");
  const std::vector<Override> changes = points[2].changes();
  CHECK(changes.size() == 3);
  CHECK(changes[1].path == "run.rtol");
  CHECK(changes[1].value == "1e-06");
  CHECK(speed::usual_steps(1.2) == std::vector<double>{1e-2, 1e-3, 1e-4, 1e-5, 1e-6});
}

TEST_CASE(
    "frontier: what is slower and no better, or lost events, or gained nothing but noise is not on it") {
  std::vector<speed::WorkRow> rows = {row("newmark", 1e-2, 1e-2, 0.1), row("newmark", 1e-3, 1e-4, 1.0),
                                      row("ida", 1e-4, 1e-3, 0.5),     row("ida", 1e-6, 1e-5, 0.9),
                                      row("exact", 0.0, 1e-14, 3.0),   row("ida", 1e-3, 2e-3, 0.47)};
  CHECK(speed::pareto_front(rows, "event_time") == std::vector<std::size_t>{0, 2, 3, 4});
  CHECK(speed::pareto_sentence(rows, "event_time") ==
        "For errors of event time down to 1.0e-02 s, newmark is cheapest (dt=0.01: 0.1 s), below that error, "
        "down to "
        "1.0e-05 s, ida is cheapest (rtol=1e-06: 0.9 s), below that error, down to 1.0e-14 s, exact is "
        "cheapest (3 s).");
  rows[3].split = "lost";
  CHECK(speed::pareto_front(rows, "event_time") == std::vector<std::size_t>{0, 2, 1, 4});
  rows[4].outcome = "stopped";
  CHECK(speed::pareto_front(rows, "event_time").back() == 1);
  rows[1].whole = false;
  CHECK(speed::pareto_front(rows, "event_time").back() == 2);
  CHECK(speed::pareto_front(rows, "displacement").empty());
  CHECK(speed::pareto_sentence(rows, "displacement") ==
        "For errors of displacement, no cheapest run can be named: no complete run has a meaningful error.");
  for (speed::WorkRow& r : rows) r.wall_times.clear();
  CHECK(speed::pareto_sentence(rows, "event_time") ==
        "For errors of event time, no cheapest run can be named: no run was timed.");
  for (speed::WorkRow& r : rows) r.whole = false;
  CHECK(speed::pareto_sentence(rows, "event_time").ends_with("the end with the reference's events."));
}

TEST_CASE("frontier: errors below what the reference is known to are one error, those too great are none") {
  std::vector<speed::WorkRow> rows = {row("exact", 0.0, 1e-9, 2.0), row("ida", 1e-6, 1e-8, 1.0),
                                      row("ida", 1e-9, 1e-12, 5.0), row("newmark", 1.0, 3.0, 0.1)};
  CHECK(speed::pareto_front(rows, "event_time") == std::vector<std::size_t>{3, 1, 0, 2});
  CHECK(speed::pareto_front(rows, "event_time", {1e-9, 1.0}) == std::vector<std::size_t>{1, 0});
  CHECK(speed::pareto_front(rows, "event_time", {1e-8, 1.0}) == std::vector<std::size_t>{1});
  rows[1].wall_times = {1.95};  // no faster than exact but for noise
  CHECK(speed::pareto_front(rows, "event_time", {1e-8, 1.0}) == std::vector<std::size_t>{0});
}
