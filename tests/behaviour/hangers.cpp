// Springs with a preload: the force that they tell, equilibrium, reactions, energy, and what is told of hangers.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "behaviour/engines.hpp"
#include "behaviour/halves.hpp"
#include "behaviour/outputs.hpp"
#include "behaviour/piping.hpp"
#include "behaviour/rates.hpp"
#include "behaviour/seen_otherwise.hpp"
#include "study/verify/verify.hpp"

namespace signorini::tests::hangers {

using namespace outputs;

namespace {

/// 2 t in a spring along a direction at an odd angle, which gravity points along.
std::string hung(const std::string& spring, const std::string& rest = "", const std::string& run = "") {
  constexpr double c = 0.28, s = 0.96;
  return fmt::format(R"(schema = 1
units = {{ force = "kN", mass = "t", length = "m", time = "s" }}
gravity = [{}, {}]
[run]
t_end = 0.5
output_dt = 0.01
{}
[nodes]
A = [1.0, 2.0]
[[masses]]
node = "A"
mass = 2.0
[[springs]]
node = "A"
direction = [{}, {}]
{}
[[springs]]
node = "A"
direction = [{}, {}]
stiffness = 900.0
)",
                     10.0 * c, 10.0 * s, run, 3.0 * c, 3.0 * s, spring, -s, c) +
         output("F", "spring", "spring = 1") + output("side", "spring", "spring = 2") + rest;
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// With the stress along all of it and the force of its hanger.
std::string pipe_with_outputs() {
  return piping::line(
      output("e", "envelope", "nodes = [\"A\", \"P\", \"B\", \"C\", \"D\"]\nquantity = \"stress\"") +
      output("hanger", "spring", "spring = 1"));
}

void same_stress(const Computed& a, const Computed& b, double relative) {
  const OutputExtremes &x = a.extremes("e"), &y = b.extremes("e");
  CHECK(y.maximum == doctest::Approx(x.maximum).epsilon(relative));
  CHECK(y.minimum == doctest::Approx(x.minimum).epsilon(relative));
  CHECK(std::abs(y.at_maximum.station - x.at_maximum.station) < 1e-2);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/hangers");

TEST_CASE(
    "a preload in equilibrium and in motion: preload + k x + c x', the closed form, and what it contains") {
  for (const std::string& engine : locating_engines) {
    CAPTURE(engine);
    const Computed rest =
        compute(hung("stiffness = 100.0\npreload = 14.0", "", "initial = \"static\""), engine);
    CHECK(rest.last("F") == doctest::Approx(20.0).epsilon(1e-10));
    CHECK(std::abs(rest.last("side")) < 1e-9);
    // 2 x'' + 3 x' + 100 x = 20 - 14
    const Computed c = compute(hung("stiffness = 100.0\ndamping = 3.0\npreload = 14.0"), engine);
    const double mean = 0.06, decay = 0.75, omega = std::sqrt(50.0 - decay * decay);
    double most = 0.0;
    for (const auto& row : c.result.responses) {
      const double e = std::exp(-decay * row.t), C = std::cos(omega * row.t), S = std::sin(omega * row.t);
      const double x = mean * (1.0 - e * (C + decay / omega * S)),
                   v = mean * e * (omega + decay * decay / omega) * S;
      most = std::max(most, std::abs(row.values[0] - (14.0 + 100.0 * x + 3.0 * v)));
    }
    CHECK(most < (engine == "newmark" ? 1e-4 : engine == "ida" ? 1e-6 : 1e-10));
    const Audit& audit = c.result.report.audit;
    CHECK(audit.energy.value < (engine == "ida" ? 1e-7 : 1e-10) * audit.energy_scale);
    CHECK(audit.energy_scale > 0.05);
    CHECK(c.model.outputs[0].contains == std::vector<std::string>{"preload", "stiffness", "damper"});
    CHECK(c.model.outputs[1].contains == std::vector<std::string>{"stiffness"});
  }
}

TEST_CASE("a constant hanger bears its load wherever the mass is") {
  const Computed c = compute(hung("preload = 20.0", "", "initial = { A = { vx = 0.5 } }"));
  for (const auto& row : c.result.responses) CHECK(row.values[0] == 20.0);
  CHECK(c.model.outputs[0].contains == std::vector<std::string>{"preload"});
  // nothing is left along the hanger: the velocity stays
  const auto& last = c.result.rows.back();
  CHECK(0.28 * last.v[0] + 0.96 * last.v[1] == doctest::Approx(0.14).epsilon(1e-12));
  CHECK(c.result.report.audit.energy.value < 1e-12 * c.result.report.audit.energy_scale);
}

TEST_CASE("what is told of hangers: cold, at the start, designed, and when they vary too much") {
  const auto model = [](const std::string& spring, const std::string& run = "initial = \"static\"") {
    return build_model(parse_scene(hung(spring, "", run), "test.toml", {}));
  };
  const auto warned = [](const Model& m, const std::string& part) {
    for (const std::string& warning : m.warnings)
      if (warning.find(part) != std::string::npos) return true;
    return false;
  };
  const Model good = model("hanger = { hot = 20.0, cold = 24.0, travel = 0.05 }");
  REQUIRE(good.hangers.size() == 1);
  CHECK(good.hangers[0].spring == 1);
  CHECK(good.hangers[0].cold == 24.0);
  CHECK(good.hangers[0].at_start == doctest::Approx(20.0).epsilon(1e-12));
  CHECK(*good.hangers[0].hot == 20.0);
  CHECK(!warned(good, "spring 1"));
  const Model soft = model("stiffness = 100.0\npreload = 14.0");
  CHECK(warned(
      soft,
      "spring 1 carries 20 kN in equilibrium and 14 kN in the undeformed state: its variability is 30 %"));
  CHECK(warned(model("stiffness = 100.0\npreload = -3.0"), "the sign differs"));
  CHECK(!warned(model("stiffness = 100.0\npreload = 14.0", ""), "spring 1"));
  CHECK(model("stiffness = 100.0").hangers.empty());
  // Gravity is along the spring's direction here, and the hanger pulls against it; turned round it would push its node down.
  const std::string along = hung("hanger = { hot = 20.0, cold = 24.0, travel = 0.05 }", "");
  const std::string round =
      with(along, "direction = [0.8400000000000001, 2.88]", "direction = [-0.84, -2.88]");
  CHECK(!warned(build_model(parse_scene(along, "test.toml", {})), "pushes its node along gravity"));
  CHECK(warned(build_model(parse_scene(round, "test.toml", {})),
               "the hanger of spring 1 pushes its node along gravity"));
  // The damper beside it is no part of what it bears, though its support moves at the start.
  std::string moved = hung("stiffness = 100.0\npreload = 14.0\ndamping = 5.0\nagainst = \"S\"", "", "");
  moved = with(moved, "[[masses]]", "S = [1.0, 5.0]\n[[masses]]") +
          "[[supports]]\nnode = \"S\"\nfix = [\"ux\"]\n[[supports]]\nnode = \"S\"\nfix = [\"uy\"]\n"
          "motion = { type = \"harmonic\", amplitude = 0.1, omega = 2.0 }\n";
  CHECK(build_model(parse_scene(moved, "test.toml", {})).hangers[0].at_start == doctest::Approx(14.0));
  // A cold load that follows is none below zero, as one that is given.
  CHECK_THROWS_WITH_AS(
      (void)model("stiffness = 400.0\nhanger = { hot = 20.0, travel = -0.06 }"),
      doctest::Contains("travel: the load in the undeformed state, hot + stiffness * travel, would be -4"),
      SceneError);
  CHECK_NOTHROW((void)model("stiffness = 400.0\nhanger = { hot = 20.0, travel = -0.05 }"));  // cold: 0
}

TEST_CASE(
    "springs with preloads between nodes, to supports and moving ones: reactions and the sum of all forces") {
  std::string text =
      frame(reactions + output("first", "spring", "spring = 1") + output("second", "spring", "spring = 2"));
  text = with(text, "stiffness = 200.0", "stiffness = 200.0\npreload = 7.0");
  text = with(text, "stiffness = 100.0", "stiffness = 100.0\npreload = -5.0");
  for (const std::string& engine : locating_engines) {
    CAPTURE(engine);
    const Computed c = compute(text, engine, {{"run.dt", "1e-3"}});
    const Audit& audit = c.result.report.audit;
    REQUIRE(audit.reactions);
    CHECK(audit.reactions->value < (engine == "ida" ? 1e-7 : 1e-10) * audit.force_scale);
    CHECK(audit.energy.value < (engine == "ida" ? 1e-6 : 1e-9) * audit.energy_scale);
    const Computed without = compute(frame(reactions), engine, {{"run.dt", "1e-3"}});
    CHECK(std::abs(c.last("Dx") - without.last("Dx")) > 1.0);
  }
  // Before anything moves: D holds what pulls it, 5/sqrt(2) less than without.
  const auto start = [](const std::string& scene) {
    const Computed c = compute(with(scene, "initial = { B = { vx = 0.3, vy = -0.2 } }", "initial = {}"));
    return c.result.responses.front().values[c.index("first")];
  };
  CHECK(start(text) == doctest::Approx(7.0).epsilon(1e-12));
}

TEST_CASE("a preload is a stage of a start with friction, and is told where none has it") {
  const std::string text =
      piping::line(output("hanger", "spring", "spring = 1") + output("snubber", "spring", "spring = 2"));
  const Computed c = compute(text);
  REQUIRE(c.model.hangers.size() == 1);
  CHECK(c.result.responses.front().values[0] == doctest::Approx(c.model.hangers[0].at_start).epsilon(1e-9));
  CHECK(std::abs(c.result.responses.front().values[1]) < 1e-12);  // in equilibrium a snubber bears nothing
  CHECK(c.extremes("snubber").maximum > 1e-3);
  CHECK(c.model.hangers[0].at_start != doctest::Approx(4.5).epsilon(1e-3));
  CHECK_THROWS_WITH_AS(
      (void)build_model(parse_scene(with(text, ", \"preload\"", ""), "test.toml", {})),
      doctest::Contains("\"preload of spring 1\" acts from the beginning, but no stage lists this load"),
      SceneError);
}

TEST_CASE("a pipe with bend, hanger, stop and shoe: energy, in halves, reduced") {
  const Computed c = compute(pipe_with_outputs());
  CHECK(c.result.events.size() > 4);
  CHECK(c.result.report.audit.energy.value < 1e-9 * c.result.report.audit.energy_scale);
  same_stress(c, compute(pipe_with_outputs() + "[reduction]\ncutoff_omega = 1e6\n"), 1e-6);
  const halves::Difference split = halves::split_text(pipe_with_outputs(), {{"run.engine", "exact"}}, 0.37);
  CHECK(split.events_agree);
  CHECK(split.state < 1e-8);
}

TEST_CASE("derivatives by a wall, a bend's radius, a content and a preload are those of differences") {
  const auto read = reader_of_text(piping::line("", "\"static\""));
  for (const char* path : {"sections.pipe.pipe.wall", "sections.pipe.pipe.content", "members.2.bend.radius",
                           "springs.1.hanger.cold"}) {
    CAPTURE(path);
    const Sensitivities s = sensitivities(read, {path});
    const double p = s.parameters[0].value, h = 1e-4 * p;
    CAPTURE(s.parameters[0].reason);
    std::vector<Result> runs;
    for (const int k : {-2, -1, 1, 2})
      runs.push_back(run_exact(read, {path, fmt::format("{:.17g}", p + k * h)}));
    REQUIRE(s.events.size() > 2);
    double greatest = 0.0;
    for (const auto& row : s.event_rates) greatest = std::max(greatest, std::abs(row[0].t));
    CHECK(greatest > 0.0);
    for (std::size_t i = 0; i < s.events.size(); ++i) {
      REQUIRE(runs[0].events.size() == s.events.size());
      const auto t = [&](std::size_t run) { return runs[run].events[i].t; };
      const double expected = (8.0 * (t(2) - t(1)) - (t(3) - t(0))) / (12.0 * h);
      CHECK(std::abs(s.event_rates[i][0].t - expected) < 1e-5 * greatest);
    }
  }
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("slow/behaviour/hangers");

TEST_CASE("a pipe with bend and hanger turned, mirrored, permuted, the other way round, in other units") {
  const Scene scene = parse_scene(piping::line("", "\"static\""), "test.toml", {{"run.engine", "exact"}});
  check_seen_otherwise(scene, 11);
}

TEST_CASE("a pipe with bend, hanger, stop and shoe: the same stresses by all engines") {
  const Computed c = compute(pipe_with_outputs());
  same_stress(c, compute(pipe_with_outputs(), "ida"), 1e-6);
  same_stress(c, compute(pipe_with_outputs(), "newmark", {{"run.dt", "5e-5"}}), 1e-3);
}

TEST_CASE("verify: envelopes, stresses of both fibres and forces with a preload agree") {
  Scene scene = parse_scene(
      piping::line(
          output("e", "envelope", "nodes = [\"A\", \"P\", \"B\", \"C\", \"D\"]\nquantity = \"stress\"") +
              output("M", "envelope", "nodes = [\"B\", \"C\"]\nquantity = \"M\"") +
              output("both", "stress", "at = [\"A\", \"P\"]") + output("hanger", "spring", "spring = 1"),
          "\"static\""),
      "test.toml", {{"run.engine", "ida"}});
  verify::VerifyRequest request;
  request.run = scene.run;
  request.max_seconds = 5.0;
  const Model model = build_model(scene);
  const verify::Verification v = verify::verify(model, model, request);
  INFO(v.sentence);
  CHECK(v.verdict == verify::Agreement::agree);
}

TEST_SUITE_END();

}  // namespace signorini::tests::hangers
