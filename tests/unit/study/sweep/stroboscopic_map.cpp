// Points of stroboscopic sweeps, against closed forms: a free oscillator, a block on a belt, a block that hystereses.
#include "study/sweep/stroboscopic_map.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <optional>
#include <utility>

#include "signorini/error.hpp"
#include "signorini/model.hpp"
#include "study/sweep/sweep_row.hpp"

using namespace signorini;

namespace {

const std::string head = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
nodes = { block = [0.0, 0.0] }
masses = [{ node = "block", mass = 2.0 }]
supports = [{ node = "block", fix = ["uy"] }]
)";

/// u = 0.03 cos 5 t
const std::string oscillator =
    head + R"(run = { t_end = 6.0, engine = "exact", initial = { block = { ux = 0.03 } } }
springs = [{ node = "block", direction = [1.0, 0.0], stiffness = 50.0 }]
[[output]]
name = "force"
kind = "spring"
spring = 1
)";

const std::string belt = head + R"(run = { t_end = 40.0, engine = "exact" }
springs = [{ node = "block", direction = [1.0, 0.0], stiffness = 8.0 }]
[[contacts]]
name = "belt"
node = "block"
law = "slider"
tangent = [1.0, 0.0]
normal_force = 10.0
friction = { static = 0.4, kinetic = 0.3 }
surface_velocity = 0.2
)";

/// Overdamped; friction 3 N.
const std::string hysteresis = head + R"(run = { t_end = 40.0, engine = "exact" }
springs = [{ node = "block", direction = [1.0, 0.0], stiffness = 50.0, damping = 60.0 }]
[[contacts]]
name = "pad"
node = "block"
law = "slider"
tangent = [1.0, 0.0]
normal_force = 10.0
friction = 0.3
[[loads]]
node = "block"
direction = [1.0, 0.0]
amplitude = 0.0
history = { type = "constant" }
)";

sweep::SweepRow row_of(const std::string& scene, const std::string& strobe,
                       std::optional<double> settle = {}) {
  sweep::RowTask task;
  task.scene = "scene.toml";  // no such file: rows are of the text
  task.text = scene;
  task.strobe = strobe;
  task.settle = settle;
  return sweep::compute_row(task);
}

/// Of a forced oscillator.
const std::string forced = head + R"(run = { t_end = 100.0, engine = "exact" }
springs = [{ node = "block", direction = [1.0, 0.0], stiffness = 50.0, damping = 4.0 }]
[[loads]]
node = "block"
direction = [1.0, 0.0]
amplitude = 3.0
history = { type = "harmonic", omega = 4.0 }
)";

std::string refusal(const std::string& text, const std::string& scene_text = belt) {
  const Scene scene = parse_scene(scene_text, "belt.toml");
  try {
    (void)sweep::parse_strobe(text, scene, build_model(scene));
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_SUITE_BEGIN("unit/study/sweep/stroboscopic_map");

TEST_CASE("strobe: states at multiples of a period, of displacement, velocity and outputs") {
  const sweep::SweepRow row = row_of(oscillator, "0.7", 0.0);
  REQUIRE(row.outcome == "done");
  REQUIRE(row.points.size() == 8);  // 0.7 to 5.6; neither the start nor t_end
  for (std::size_t k = 0; k < row.points.size(); ++k) {
    const double t = 0.7 * static_cast<double>(k + 1);
    CAPTURE(t);
    CHECK(row.points[k].t == doctest::Approx(t).epsilon(1e-15));
    REQUIRE(row.points[k].values.size() == 3);
    CHECK(std::abs(row.points[k].values[0] - 0.03 * std::cos(5.0 * t)) < 1e-13);
    CHECK(std::abs(row.points[k].values[1] + 0.15 * std::sin(5.0 * t)) < 1e-12);
    CHECK(std::abs(std::abs(row.points[k].values[2]) - std::abs(1.5 * std::cos(5.0 * t))) < 1e-11);
  }
  // The end of the run is a point where it is a multiple.
  CHECK(row_of(oscillator, "1.5", 0.0).points.back().t == 6.0);
}

TEST_CASE("strobe: without --settle the second half of the run has points") {
  const sweep::SweepRow row = row_of(oscillator, "0.5");
  REQUIRE(row.points.size() == 7);
  CHECK(row.points.front().t == 3.0);
}

TEST_CASE("strobe: after events the block has the velocity of its belt") {
  const sweep::SweepRow sticks = row_of(belt, "stick@belt", 0.0);
  const sweep::SweepRow slips = row_of(belt, "slip", 0.0);
  REQUIRE(sticks.points.size() == static_cast<std::size_t>(sticks.events.at("stick")));
  REQUIRE(slips.points.size() == static_cast<std::size_t>(slips.events.at("slip")));
  REQUIRE(sticks.points.size() > 3);
  for (const sweep::StroboscopicPoint& point : sticks.points)
    CHECK(point.values[1] == doctest::Approx(0.2).epsilon(1e-12));
  // Stuck until the spring has the static limit: 4 N / 8 N/m.
  for (const sweep::StroboscopicPoint& point : slips.points)
    CHECK(point.values[0] == doctest::Approx(0.5).epsilon(1e-11));
}

TEST_CASE("strobe: every engine that locates events, and parts that nothing couples") {
  const std::string apart = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
run = { t_end = 6.0, dt = 1e-3, initial = { block = { ux = 0.03 } } }
nodes = { block = [0.0, 0.0], other = [5.0, 1.0] }
masses = [{ node = "block", mass = 2.0 }, { node = "other", mass = 1.0 }]
supports = [{ nodes = ["block", "other"], fix = ["uy"] }]
springs = [{ node = "block", direction = [1.0, 0.0], stiffness = 50.0 },
           { node = "other", direction = [1.0, 0.0], stiffness = 9.0 }]
[[contacts]]
name = "stop"
node = "block"
law = "compliant"
normal = [1.0, 0.0]
gap = 0.01
normal_stiffness = 1000.0
[[contacts]]
name = "wall"
node = "other"
law = "rigid"
normal = [1.0, 0.0]
gap = 0.004
)";
  for (const auto& [engine, tolerance] :
       {std::pair{"exact", 1e-12}, std::pair{"ida", 1e-6}, std::pair{"newmark", 1e-5}}) {
    CAPTURE(engine);
    sweep::RowTask task;
    task.scene = "scene.toml";  // no such file: rows are of the text
    task.text = apart;
    task.changes = {{"run.engine", std::string("\"") + engine + "\""}};
    task.strobe = "contact@stop";
    task.settle = 0.0;
    const sweep::SweepRow row = sweep::compute_row(task);
    REQUIRE(row.points.size() == static_cast<std::size_t>(row.events.at("contact")));
    // u = -0.01 with all of the energy of the start: v^2 = 25 (0.03^2 - 0.01^2).
    for (const sweep::StroboscopicPoint& point : row.points) {
      CHECK(std::abs(point.values[0] + 0.01) <= tolerance * 0.01);
      CHECK(std::abs(point.values[1] + std::sqrt(0.02)) <= tolerance * std::sqrt(0.02));
      CHECK(point.values[2] == 0.0);
    }
  }
}

TEST_CASE("strobe: runs that go on from each other show the hysteresis of friction") {
  sweep::RowTask task;
  task.scene = "scene.toml";  // no such file: rows are of the text
  task.text = hysteresis;
  task.strobe = "10";
  std::optional<SavedState> carried;
  double u = 0.0;
  for (const double load : {2.0, 7.0, 12.0, 10.0, 6.0, 1.0, -4.0}) {
    CAPTURE(load);
    task.changes = {{"loads.1.amplitude", std::to_string(load)}};
    const sweep::SweepRow row = sweep::compute_row(task, carried);
    REQUIRE(row.outcome == "done");
    REQUIRE(carried);
    // It moves where the spring and the load leave more than 3 N, until they leave 3 N.
    u = std::min(std::max(u, (load - 3.0) / 50.0), (load + 3.0) / 50.0);
    REQUIRE_FALSE(row.points.empty());
    CHECK(std::abs(row.points.back().values[0] - u) < 1e-9);
  }
  // A run that is refused leaves the state as it was.
  task.changes = {{"loads.1.amplitude", "-4.0"}, {"contacts.pad.friction", "-1"}};
  CHECK(sweep::compute_row(task, carried).outcome == "refused");
  task.changes = {{"loads.1.amplitude", "-2.0"}};
  CHECK(std::abs(sweep::compute_row(task, carried).points.back().values[0] - u) < 1e-9);
}

TEST_CASE(
    "strobe: at the period of each run's loads the steady state has one point, where its closed form is") {
  // m u'' + c u' + k u = F sin w t: u = F (D sin w t - C cos w t)/(D^2 + C^2), D = k - m w^2, C = c w, at phase 0
  for (const double w : {2.0, 4.0, 7.3}) {
    CAPTURE(w);
    sweep::RowTask task;
    task.scene = "scene.toml";  // no such file: rows are of the text
    task.text = forced;
    task.changes = {{"loads.1.history.omega", std::to_string(w)}};
    task.strobe = "loads";
    const sweep::SweepRow row = sweep::compute_row(task);
    REQUIRE(row.outcome == "done");
    const double D = 50.0 - 2.0 * w * w, C = 4.0 * w, square = D * D + C * C;
    REQUIRE(row.points.size() > 10);
    for (const sweep::StroboscopicPoint& point : row.points) {
      CHECK(std::abs(point.values[0] + 3.0 * C / square) <= 1e-11);
      CHECK(std::abs(point.values[1] - 3.0 * D * w / square) <= 1e-11);
    }
    CHECK(row.t <= 100.0);
    CHECK(row.t > 100.0 - 2.0 * 3.141592653589794 / w);
    CHECK(row.points.back().t == row.t);
  }
  CHECK(refusal("loads").find("no periodic load") != std::string::npos);
  CHECK(refusal("loads", forced).empty());
}

TEST_CASE("strobe: a period that is none of the loads is doubted, a multiple of theirs is not") {
  const Scene scene = parse_scene(forced, "forced.toml");
  const Model model = build_model(scene);
  const double T = 3.141592653589793 / 2.0;
  const auto doubt = [&](double period) {
    return sweep::strobe_warning(sweep::parse_strobe(std::to_string(period), scene, model), scene);
  };
  const auto exact = [&](double turns) {
    sweep::StroboscopicMap strobe;
    strobe.period = turns * T;
    return sweep::strobe_warning(strobe, scene);
  };
  CHECK(exact(1.0).empty());
  CHECK(exact(3.0).empty());
  CHECK(exact(0.5).find("--strobe loads") != std::string::npos);
  CHECK(doubt(1.5).find("--strobe loads") != std::string::npos);
  CHECK(doubt(1.5707).find("1.5707963") != std::string::npos);
  const Scene belted = parse_scene(belt, "belt.toml");
  CHECK(sweep::strobe_warning(sweep::parse_strobe("1.5", belted, build_model(belted)), belted).empty());
}

TEST_CASE("strobe: rows keep their points on disk") {
  const sweep::SweepRow row = row_of(oscillator, "0.7");
  const sweep::SweepRow again = sweep::parse_row(sweep::row_line(row));
  REQUIRE(again.points.size() == row.points.size());
  for (std::size_t k = 0; k < row.points.size(); ++k) {
    CHECK(again.points[k].t == row.points[k].t);
    CHECK(again.points[k].values == row.points[k].values);
  }
}

TEST_CASE("strobe: what is neither a period nor an event is refused by name") {
  for (const char* text : {"0", "-1", "inf", "nan"})
    CHECK(refusal(text).find("above 0") != std::string::npos);
  CHECK(refusal("stik").find("stick") != std::string::npos);
  CHECK(refusal("stick@bet").find("belt") != std::string::npos);
  CHECK(refusal("stick@belt").empty());
  CHECK(refusal("").find("expected a period") != std::string::npos);
}

TEST_SUITE_END();
