// Engine exact in modes against its Taylor series: the same events at the same times, and a balance that
// closes.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "run/choose_engine.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

Result run_scene(double f, bool modal) {
  const Scene scene =
      read_scene(SIGNORINI_MODELS "/pipeline.toml", {{"contacts.*.friction", fmt::format("{}", f)},
                                                     {"run.engine", "exact"},
                                                     {"run.output_dt", "1e-2"},
                                                     {"run.flow", modal ? "modal" : "taylor"}});
  return simulate(build_model(scene), scene.run);
}

Result with_flow(const std::string& text, const char* flow) {
  const Scene scene = parse_scene(text, "flows.toml", {{"run.engine", "exact"}, {"run.flow", flow}});
  return simulate(build_model(scene), scene.run);
}

void same_events(const std::string& text, double tolerance) {
  const Result modes = with_flow(text, "modal"), series = with_flow(text, "taylor");
  CHECK(modes.report.outcome.kind == Outcome::Kind::done);
  REQUIRE(modes.events.size() == series.events.size());
  for (std::size_t i = 0; i < modes.events.size(); ++i) {
    CHECK(modes.events[i].contact == series.events[i].contact);
    CHECK(modes.events[i].type == series.events[i].type);
    CHECK(std::abs(modes.events[i].t - series.events[i].t) < tolerance);
  }
}

/// The same events, motions, forces, peaks and works by both flows, in complex modes but for so many segments.
void same_laws(const std::string& text, double tolerance, long fallbacks = 0) {
  CAPTURE(text);
  const Result modes = with_flow(text, "modal"), series = with_flow(text, "taylor");
  CHECK(modes.report.method.flow_reason == "as given: complex modes");
  REQUIRE(modes.report.outcome.kind == Outcome::Kind::done);
  CHECK(modes.report.counters.fallbacks <= fallbacks);
  REQUIRE(modes.events.size() == series.events.size());
  CHECK(modes.events.size() > 8);
  double force = 0.0;
  for (const Event& event : series.events) force = std::max(force, std::abs(event.N));
  for (std::size_t i = 0; i < modes.events.size(); ++i) {
    const Event &a = modes.events[i], &b = series.events[i];
    CAPTURE(b.t);
    REQUIRE(a.contact == b.contact);
    REQUIRE(a.type == b.type);
    REQUIRE(a.to == b.to);
    CHECK(std::abs(a.t - b.t) < tolerance);
    CHECK(std::abs(a.N - b.N) < 1e-7 * force);
    CHECK(std::abs(a.T - b.T) < 1e-7 * force);
  }
  REQUIRE(std::isfinite(modes.report.audit.final.balance()));
  CHECK(modes.report.audit.energy.value < 1e-11 * modes.report.audit.energy_scale);
  CHECK(modes.report.audit.equilibrium.value < 1e-9 * modes.report.audit.force_scale);
  REQUIRE(modes.rows.size() == series.rows.size());
  for (std::size_t i = 0; i < modes.rows.size(); ++i) {
    const auto &a = modes.rows[i], &b = series.rows[i];
    CHECK((a.u - b.u).norm() < 1e-9 * (1e-3 + b.u.norm()));
    const double scale = modes.report.audit.energy_scale;
    CHECK(std::abs(a.energy.damping - b.energy.damping) < 1e-9 * scale);
    CHECK(std::abs(a.energy.friction - b.energy.friction) < 1e-9 * scale);
    CHECK(std::abs(a.energy.loads - b.energy.loads) < 1e-9 * scale);
  }
  for (std::size_t c = 0; c < modes.report.peaks.size(); ++c) {
    const Peak &a = modes.report.peaks[c], &b = series.report.peaks[c];
    CHECK(a.N == doctest::Approx(b.N).epsilon(1e-6));
    CHECK(a.T == doctest::Approx(b.T).epsilon(1e-6));
  }
}

const std::string head = R"(schema = 1
title = "flows"
units = { force = "N", mass = "kg", length = "m", time = "s" }
gravity = [0.0, -9.81]
)";

}  // namespace

TEST_SUITE_BEGIN("behaviour/modal_flow");

TEST_CASE(
    "pipeline: both flows find the same events at the same times, forces and peaks; their balances close") {
  for (const double f : {0.0, 0.1, 0.3, 0.9, 1.3}) {
    CAPTURE(f);
    const Result modes = run_scene(f, true), series = run_scene(f, false);
    REQUIRE(modes.report.outcome.kind == Outcome::Kind::done);
    CHECK(modes.report.warnings == series.report.warnings);
    CHECK(modes.report.counters.fallbacks == 0);
    // Steps of the flow in modes end at events; those of the series are 5 radians of the fastest motion.
    CHECK(modes.report.counters.steps < 500);
    CHECK(series.report.counters.steps > 10000);
    REQUIRE(modes.events.size() == series.events.size());
    for (std::size_t i = 0; i < modes.events.size(); ++i) {
      const Event &a = modes.events[i], &b = series.events[i];
      CAPTURE(b.t);
      REQUIRE(a.contact == b.contact);
      REQUIRE(a.type == b.type);
      REQUIRE(a.to == b.to);
      CHECK(std::abs(a.t - b.t) < 2e-12);  // seen: 9.4e-13 (f = 0.1)
      CHECK(std::abs(a.N - b.N) < 1e-5);
    }
    // 4e-13 to 1.5e-11 with friction; written so that NaN fails
    REQUIRE(std::isfinite(modes.report.audit.final.balance()));
    CHECK(modes.report.audit.energy.value < 5e-11 * modes.report.audit.energy_scale);
    CHECK(modes.report.audit.equilibrium.value < 1e-9 * modes.report.audit.force_scale);
    REQUIRE(modes.rows.size() == series.rows.size());
    for (std::size_t i = 0; i < modes.rows.size(); ++i) {
      const auto &a = modes.rows[i], &b = series.rows[i];
      CHECK((a.u - b.u).cwiseAbs().maxCoeff() < 1e-9);
      CHECK(a.energy.damping == doctest::Approx(b.energy.damping).epsilon(1e-8));
      CHECK(a.energy.friction == doctest::Approx(b.energy.friction).epsilon(1e-8));
      CHECK(a.energy.loads == doctest::Approx(b.energy.loads).epsilon(1e-8));
    }
    for (std::size_t c = 0; c < 2; ++c) {
      const Peak &a = modes.report.peaks[c], &b = series.report.peaks[c];
      CHECK(a.tangential == doctest::Approx(b.tangential).epsilon(1e-5));
      CHECK(a.normal == doctest::Approx(b.normal).epsilon(1e-5));
      CHECK(a.N == doctest::Approx(b.N).epsilon(1e-5));
      CHECK(a.T == doctest::Approx(b.T).epsilon(1e-5));
    }
  }
}

TEST_CASE("flows: a state with too few modes is left to the series, and no event is lost") {
  // Slip: the vertical mode gets the frequency of the horizontal one, and friction couples them one way.
  same_events(head + R"(
[run]
t_end = 2
output_dt = 0.01
initial = { b0 = { vx = 1.84, vy = 0 } }
[damping]
alpha = 0.5
[nodes]
b0 = [0.0, 0.0]
[[masses]]
node = "b0"
mass = 1.31
[[springs]]
node = "b0"
direction = [1, 0]
stiffness = 239
[[contacts]]
name = "floor"
node = "b0"
law = "compliant"
normal = [0, 1]
gap = 0
normal_stiffness = 239
tangential_stiffness = 119.5
friction = 0.1
[[loads]]
node = "b0"
direction = [1, -0.8]
amplitude = 39.77
history = { type = "rectangle", start = 0.127, end = 0.783 }
)",
              1e-14);
}

TEST_CASE("flows: stiff beside soft, and bodies that share no spring") {
  same_events(head + R"(
[run]
t_end = 0.5
output_dt = 0.0025
initial = { b0 = { vx = -0.87, vy = 0 }, b1 = { vx = -1.71, vy = 0 } }
[damping]
alpha = 2.0
[nodes]
b0 = [0.0, 0.0]
b1 = [1.0, 0.0]
[[masses]]
node = "b0"
mass = 2.2
[[springs]]
node = "b0"
direction = [1, 0.3]
stiffness = 159
[[masses]]
node = "b1"
mass = 0.95
[[contacts]]
name = "floor0"
node = "b0"
law = "compliant"
normal = [0, 1]
gap = 0
normal_stiffness = 10000
tangential_stiffness = 5000
friction = 0.1
[[contacts]]
name = "wall0"
node = "b0"
law = "compliant"
normal = [-1.0, 0.0]
gap = 0.064
normal_stiffness = 10000
friction = 0
[[contacts]]
name = "floor1"
node = "b1"
law = "compliant"
normal = [0, 1]
gap = 0
normal_stiffness = 10000
tangential_stiffness = 3000
friction = { static = 0.3, kinetic = 0.161 }
[[loads]]
node = "b1"
direction = [1, -0.5]
amplitude = 37.64
history = { type = "step", start = 0.068 }
[base_motion]
direction = [1.0, 0.5]
acceleration = 7.0562
)",
              2e-13);  // 5.8e-12 where modes were found in double
}

TEST_CASE("flows: a lift-off that the rounding of the modes blurs is a lift-off") {
  same_events(head + R"(
[run]
t_end = 0.2
output_dt = 0.001
initial = "static"
[sections.beam]
EA = 10000
EI = 50
mass_per_length = 1
[damping]
alpha = 2
[nodes]
A = [0, 0]
B = [0, 1.05]
C = [1.66, 1.05]
D = [1.66, 0]
[[members]]
nodes = ["A", "B", "C", "D"]
section = "beam"
elements = 1
[[contacts]]
name = "footA"
node = "A"
law = "compliant"
normal = [0.0, 1.0]
gap = 0
normal_stiffness = 1000000
tangential_stiffness = 300000
friction = 0.5
[[contacts]]
name = "footD"
node = "D"
law = "compliant"
normal = [0.0, 1.0]
gap = 0
normal_stiffness = 1000000
tangential_stiffness = 500000
friction = 0.3
[[loads]]
node = "B"
direction = [-0.39, -1]
amplitude = 113
history = { type = "rectangle", start = 0.043, end = 0.07 }
[[loads]]
node = "B"
direction = [0.59, 1]
amplitude = 143.04
history = { type = "step", start = 0 }
[base_motion]
direction = [1.0, 0.2]
acceleration = 1.0
)",
              2e-12);  // seen: 6.5e-13, after impacts on springs of 1e6 N/m
}

TEST_CASE("flows: auto follows the pipeline in modes, and few unknowns or what modes refuse by series") {
  const auto flow_of = [](const std::vector<Override>& changes) {
    std::vector<Override> all{{"run.engine", "exact"}, {"run.t_end", "1e-3"}};
    all.insert(all.end(), changes.begin(), changes.end());
    const Scene scene = read_scene(SIGNORINI_MODELS "/pipeline.toml", all);
    return simulate(build_model(scene), scene.run).report.method.flow_reason;
  };
  CHECK(flow_of({}) == "auto: modes can compute the whole scene");
  CHECK(flow_of({{"members.1.elements", "[1,1]"}}) ==
        "auto: the scene has so few unknowns that the series is as fast as modes");
  CHECK(flow_of({{"contacts.first.tangential_damping", "10.0"}}) ==
        "auto: series, because the scene has shear elements");
  CHECK(flow_of({{"run.flow", "taylor"}}) == "as given");
}

TEST_CASE(
    "flows: auto takes complex modes where they gain, and leaves rigid hits and many springs to the series") {
  const auto chosen = [](const std::string& model, std::vector<Override> changes) {
    changes.push_back({"run.engine", "exact"});
    const Scene scene = read_scene(std::string(SIGNORINI_MODELS "/") + model, changes);
    return run::choose_flow(build_model(scene), scene.run).reason;
  };
  const std::string gains = "auto: complex modes can compute the whole scene",
                    dear = "auto: the complex modes of the contact states would cost as much as the series";
  CHECK(chosen("pipeline.toml", {{"contacts.first.normal_damping", "10.0"}}) == gains);
  CHECK(chosen("pipeline.toml", {{"damping.beta", "1e-8"}}) == gains);
  CHECK(chosen("pipeline.toml", {{"damping.beta", "1e-8"}, {"members.1.elements", "[2,6]"}}) == dear);
  CHECK(chosen("pipeline.toml", {{"damping.beta", "1e-8"}, {"run.t_end", "0.1"}}) == dear);
  CHECK(chosen("rigid-frame.toml", {{"members.1.elements", "[8,4,8]"}}) ==
        "auto: hits of rigid contacts excite the whole mesh, so complex modes save no time");
  CHECK(chosen("piping.toml", {}) ==
        "auto: with this many contacts, computing the modes of each contact state costs more than it saves");
}

TEST_CASE(
    "flows: states with more springs than modes are made for are left to the series, the others are not") {
  std::string text = head + R"(
[run]
t_end = 0.15
output_dt = 0.02
initial = "static"
[damping]
alpha = 12.0
[sections.pipe]
EA = 9.0e6
EI = 2.0e4
mass_per_length = 0.4
)";
  std::string nodes = "[nodes]\n", list, contacts;
  constexpr int supports = 7;  // with two springs each
  for (int i = 0; i < supports; ++i) {
    nodes += fmt::format("P{} = [{}.0, 0.0]\n", i, 3 * i);
    list += fmt::format("{}\"P{}\"", i > 0 ? ", " : "", i);
    contacts += fmt::format(
        "[[contacts]]\nname = \"c{0}\"\nnode = \"P{0}\"\nnormal = [0, 1]\nlaw = \"compliant\"\n"
        "normal_stiffness = 1e6\ntangential_stiffness = 1e6\nfriction = 0.3\n",
        i);
  }
  text += nodes + "[[members]]\nnodes = [" + list + "]\nsection = \"pipe\"\nelements = 1\n" + contacts + R"(
[[loads]]
node = "P2"
direction = [0.6, 0.8]
amplitude = 60.0
history = { type = "rectangle", start = 0.0, end = 0.05 }
)";
  const Result modes = with_flow(text, "modal");
  CHECK(modes.report.counters.fallbacks > 0);
  CHECK(modes.report.counters.contact_states > 10);
  CHECK(modes.report.counters.fallbacks < modes.report.counters.restarts / 2);
  CHECK(modes.events.size() > 100);
  same_events(text,
              1e-12);  // seen: 4e-14; the motion parts its neighbours by a factor of 1e3 in the next 0.15 s
}

namespace {

/// A portal on two feet, which a pulse lifts; {} is where laws, damping and histories differ.
std::string portal(const std::string& damping, const std::string& feet, const std::string& more) {
  return head + R"(
[run]
t_end = 0.15
output_dt = 0.01
initial = "static"
[sections.beam]
EA = 10000
EI = 50
mass_per_length = 1
[nodes]
A = [0, 0]
B = [0, 1.05]
C = [1.66, 1.05]
D = [1.66, 0]
[[members]]
nodes = ["A", "B", "C", "D"]
section = "beam"
elements = 1
[[loads]]
node = "B"
direction = [0.6, 1]
amplitude = 120
history = { type = "rectangle", start = 0.02, end = 0.05 }
)" + damping +
         "\n" + more +
         fmt::format(
             "[[contacts]]\nname = \"A\"\nnode = \"A\"\nnormal = [0, 1]\n{}\n[[contacts]]\nname = "
             "\"D\"\nnode = \"D\"\nnormal = [0, 1]\n{}\n",
             feet, feet);
}

const char soft_feet[] =
    "law = \"compliant\"\nnormal_stiffness = 1e5\ntangential_stiffness = 3e4\nfriction = 0.4";
const char alpha[] = "[damping]\nalpha = 2";

}  // namespace

TEST_CASE("complex modes: damping beta K, single dampers, dashpots of contacts, no damping at all") {
  same_laws(portal("[damping]\nalpha = 1\nbeta = 2e-5", soft_feet, ""), 1e-12);
  same_laws(portal(alpha, soft_feet,
                   "[[springs]]\nnode = \"C\"\ndirection = [1, 0]\nstiffness = 200\ndamping = 6\n"),
            1e-12, 1);  // in flight two free motions, which the damper sees by its rounding
  same_laws(portal(alpha, std::string(soft_feet) + "\nnormal_damping = 30", ""), 1e-12);
  same_laws(
      portal("", soft_feet, "[[springs]]\nnode = \"C\"\ndirection = [1, 0]\nstiffness = 200\ndamping = 6\n"),
      1e-12, 8);  // free motions without damping are the series'
  // Two roots whose sum hardly acts within the run: what is lost to them is 1e-4 of the energy.
  same_laws(portal("[damping]\nalpha = 2e-3\nbeta = 2e-9", soft_feet, ""), 1e-12, 10);
}

TEST_CASE("complex modes: rigid contacts, with friction and rebounds") {
  const char rigid[] = "law = \"rigid\"\nrestitution = 0.3\nfriction = 0.3\ncapture_velocity = 1e-2";
  same_laws(portal(alpha, rigid, ""), 1e-10);
}

TEST_CASE("complex modes: ramps, harmonic loads and moving supports") {
  same_laws(portal(alpha, soft_feet,
                   "[[loads]]\nnode = \"C\"\ndirection = [1, 0]\namplitude = 40\n"
                   "history = { type = \"harmonic\", omega = 37.0 }\n"
                   "[[loads]]\nnode = \"B\"\ndirection = [0, -1]\namplitude = 40\n"
                   "history = { type = \"triangle\", start = 0.01, end = 0.09 }\n"),
            1e-12);
}

TEST_CASE("complex modes: a ramp much shorter than the slow modes that it drives loses no digits") {
  // Slow motions of the frame on its open foot turn by 0.02 rad and less in the ramps' 8 ms. Backwards from the ramp their answers
  // cancelled, and left 2e-10 s of an event.
  for (const double angle : {0.0, 0.6}) {
    const auto turned = [&](double x, double y) {
      return fmt::format("[{:.17g}, {:.17g}]", x * std::cos(angle) - y * std::sin(angle),
                         x * std::sin(angle) + y * std::cos(angle));
    };
    const std::string soft = "law = \"compliant\"\nnode = \"D\"\n";
    same_events(
        "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\ngravity = " +
            turned(0.0, -9.81) + "\n[run]\nt_end = 0.1\noutput_dt = 0.01\ninitial = { B = { " +
            fmt::format("vx = {:.17g}, vy = {:.17g}", -0.08 * std::cos(angle) - 0.3 * std::sin(angle),
                        -0.08 * std::sin(angle) + 0.3 * std::cos(angle)) +
            " } }\n[sections.beam]\nEA = 10000\nEI = 50\nmass_per_length = 1\n" +
            "[damping]\nalpha = 10\nbeta = 1e-5\n[nodes]\nA = " + turned(0.0, 0.0) +
            "\nB = " + turned(0.0, 1.92) + "\nC = " + turned(2.28, 1.92) + "\nD = " + turned(2.28, 0.0) +
            "\n[[members]]\nnodes = [\"A\", \"B\", \"C\", \"D\"]\nsection = \"beam\"\nelements = 1\n" +
            "[[supports]]\nnode = \"A\"\nfix = [\"ux\", \"uy\"]\n[[contacts]]\nname = \"foot\"\n" + soft +
            "normal = " + turned(0.0, 1.0) + "\ngap = 0.0005\nnormal_stiffness = 1e6\n" +
            "tangential_stiffness = 1e6\nfriction = { static = 0.3, kinetic = 0.227 }\n[[contacts]]\n" +
            "name = \"stop\"\n" + soft + "normal = " + turned(-1.0, 0.0) +
            "\ngap = 0.0133\nnormal_stiffness = 1e5\n[[loads]]\nnode = \"B\"\ndirection = " +
            turned(-0.37, -1.0) + "\namplitude = 147.37\nhistory = { type = \"harmonic\", omega = 682.27, " +
            "phase = 1 }\n[[loads]]\nnode = \"B\"\ndirection = " + turned(-0.76, -1.0) +
            "\namplitude = 140.92\nhistory = { type = \"triangle\", start = 0, end = 0.016 }\n",
        1e-13);
  }
}

TEST_CASE(
    "complex modes: sliders with and without a tangential stiffness on a belt, under a force that varies") {
  const auto block = [](const char* law) {
    return head + R"(
[run]
t_end = 6
output_dt = 0.1
initial = { b0 = { ux = 0.3 } }
[damping]
alpha = 0.05
[nodes]
b0 = [0.0, 0.0]
b1 = [1.0, 0.0]
[[masses]]
node = "b0"
mass = 1.3
[[masses]]
node = "b1"
mass = 0.7
[[springs]]
node = "b0"
direction = [1, 0]
stiffness = 40
[[springs]]
node = "b0"
against = "b1"
direction = [1, 0]
stiffness = 60
damping = 0.1
[[springs]]
node = "b0"
direction = [0, 1]
stiffness = 40
[[springs]]
node = "b1"
direction = [0, 1]
stiffness = 60
[[contacts]]
name = "belt"
node = "b1"
law = "slider"
normal = [0, 1]
normal_force = { type = "harmonic", offset = 10.0, amplitude = 4.0, omega = 3.0 }
surface_velocity = 0.2
friction = { static = 0.4, kinetic = 0.25 }
)" + law;
  };
  same_laws(block(""), 1e-11);
  same_laws(block("tangential_stiffness = 900"), 1e-11);
}
