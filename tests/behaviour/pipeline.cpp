// The main scene: counts and peaks of the exact flow of this layout (a reconstruction of the paper's).
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

struct Row {
  double f, first_horizontal, first_vertical, second_horizontal;  // mm
  long events;
};

constexpr Row table[] = {{0.0, 42.43, 10.97, 41.36, 116}, {0.1, 36.80, 10.85, 35.12, 386},
                         {0.3, 30.44, 10.61, 29.58, 250}, {0.5, 26.01, 10.38, 24.38, 192},
                         {0.7, 21.83, 10.15, 19.62, 199}, {1.0, 16.34, 9.82, 13.87, 187},
                         {1.3, 12.65, 9.62, 9.93, 237}};

Result run_scene(double f, const char* rtol, const char* t_end = "1.2", const char* engine = "ida") {
  const Scene scene =
      read_scene(SIGNORINI_MODELS "/pipeline.toml", {{"contacts.*.friction", fmt::format("{}", f)},
                                                     {"run.rtol", rtol},
                                                     {"run.t_end", t_end},
                                                     {"run.engine", engine}});
  return simulate(build_model(scene), scene.run);
}

long count(const Result& result) {
  long n = 0;
  for (const Event& e : result.events) n += e.type != EventType::time;
  return n;
}

void check_peaks(const Result& result, const Row& row, double millimetres) {
  const auto& p = result.report.peaks;
  CHECK(std::abs(1e3 * p[0].tangential - row.first_horizontal) < millimetres);
  CHECK(std::abs(1e3 * p[0].normal - row.first_vertical) < millimetres);
  CHECK(std::abs(1e3 * p[1].tangential - row.second_horizontal) < millimetres);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/pipeline");

TEST_CASE("first events at f = 0.3") {
  const Result result = run_scene(0.3, "1e-10", "0.0035");
  REQUIRE(result.events.size() >= 2);
  CHECK(result.events[0].t == doctest::Approx(1.939e-3).epsilon(3e-4));
  CHECK(result.events[0].contact == 0);
  CHECK(result.events[0].to == State::slip_minus);
  CHECK(result.events[1].t == doctest::Approx(2.631e-3).epsilon(2e-4));
  CHECK(result.events[1].to == State::open);
}

TEST_CASE("static start, damping and free motion") {
  const Model model = build_model(read_scene(SIGNORINI_MODELS "/pipeline.toml"));
  CHECK(model.size() == 51);
  CHECK(model.alpha == doctest::Approx(17.8182).epsilon(1e-5));
  CHECK(model.statics.reactions[0] == doctest::Approx(58.86).epsilon(1e-6));
  CHECK(model.statics.reactions[1] == doctest::Approx(35.316).epsilon(1e-6));
  REQUIRE(model.statics.free_motions.size() == 1);
  CHECK(model.statics.free_motions[0].find("horizontal") != std::string::npos);
}

// Its flight was once taken for a touch: the run went on into the ground and stopped.
TEST_CASE(
    "a flight of a few tolerances ends with a landing: f = 1.3 at rtol 1e-6, every event that `exact` "
    "finds") {
  const Result result = run_scene(1.3, "1e-6", "0.15"), exact = run_scene(1.3, "1e-6", "0.15", "exact");
  INFO(result.report.outcome.reason);
  CHECK(result.report.outcome.kind == Outcome::Kind::done);
  REQUIRE(exact.events.size() > 100);
  REQUIRE(result.events.size() == exact.events.size());
  for (std::size_t i = 0; i < exact.events.size(); ++i) {
    CAPTURE(i);
    CHECK(result.events[i].contact == exact.events[i].contact);
    CHECK(result.events[i].from == exact.events[i].from);
    CHECK(result.events[i].to == exact.events[i].to);
    CHECK(std::abs(result.events[i].t - exact.events[i].t) < 1e-6);
  }
}

TEST_CASE("the load that ends is one time row, and no step crosses it") {
  const Result result = run_scene(0.3, "1e-6", "0.102");
  int rows = 0;
  for (const Event& e : result.events)
    if (e.type == EventType::time) {
      ++rows;
      CHECK(e.t == 0.1);
      CHECK(e.contact == -1);
    }
  CHECK(rows == 1);
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("slow/pipeline");

TEST_CASE(
    "f = 0.3 at rtol 1e-10: 250 events, landing directly into slip+, energy to 1e-7 of the loads' work") {
  const Result result = run_scene(0.3, "1e-10");
  CHECK(count(result) == 250);
  check_peaks(result, table[2], 0.006);
  bool landed = false;
  for (const Event& e : result.events)
    if (e.contact == 0 && e.type == EventType::contact && !landed) {
      landed = true;
      CHECK(e.t == doctest::Approx(0.15487).epsilon(4e-5));
      CHECK(e.to == State::slip_plus);
    }
  CHECK(landed);
  CHECK(result.report.audit.energy.value < 1e-7 * result.report.audit.work_of_loads);
}

TEST_CASE("all coefficients of friction at rtol 1e-8: counts and peaks of the table") {
  for (const Row& row : table) {
    CAPTURE(row.f);
    const Result result = run_scene(row.f, "1e-8");
    CHECK(count(result) == row.events);
    check_peaks(result, row, 0.006);
  }
}

TEST_CASE("rtol 1e-6 keeps the energy to 1e-4 of the loads' work and the peaks to 0.5 %") {
  const Result result = run_scene(0.3, "1e-6");
  check_peaks(result, table[2], 0.05);
  CHECK(result.report.audit.energy.value < 1e-4 * result.report.audit.work_of_loads);
}

TEST_CASE("by the exact flow: counts and peaks of the whole table, energy to roundoff") {
  for (const Row& row : table) {
    CAPTURE(row.f);
    const Result result = run_scene(row.f, "1e-8", "1.2", "exact");
    CHECK(count(result) == row.events);
    check_peaks(result, row, 0.0051);  // half of the last printed digit
    CHECK(result.report.audit.energy.value < 1e-10 * result.report.audit.energy_scale);
  }
}

TEST_CASE("both engines see the same run at f = 0.3, event by event, within ida's tolerance") {
  const Result exact = run_scene(0.3, "1e-8", "1.2", "exact"), ida = run_scene(0.3, "1e-10");
  REQUIRE(exact.events.size() == ida.events.size());
  for (std::size_t i = 0; i < exact.events.size(); ++i) {
    CAPTURE(i);
    CHECK(exact.events[i].contact == ida.events[i].contact);
    CHECK(exact.events[i].to == ida.events[i].to);
    CHECK(std::abs(exact.events[i].t - ida.events[i].t) < 1e-8);
  }
}

TEST_SUITE_END();
