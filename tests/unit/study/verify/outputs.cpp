// Outputs in `verify`: rows and extremes beside newmark's limits, and events that follow from others.
#include <doctest/doctest.h>

#include <algorithm>

#include "signorini/simulate.hpp"
#include "study/verify/verify.hpp"

using namespace signorini;

namespace {

/// A mass on a spring over a node without mass, a stop, and outputs of three units.
const char* const swinging = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 2.0
initial = { m = { ux = 0.1 } }
[nodes]
m = [0.0, 0.0]
p = [1.0, 0.0]
[[masses]]
node = "m"
mass = 1.0
[[supports]]
node = "m"
fix = ["uy"]
[[supports]]
node = "p"
fix = ["uy"]
[[springs]]
node = "m"
against = "p"
direction = [1.0, 0.0]
stiffness = 200.0
[[springs]]
node = "p"
direction = [1.0, 0.0]
stiffness = 200.0
[[contacts]]
name = "stop"
node = "m"
law = "compliant"
normal = [1.0, 0.0]
gap = 0.05
normal_stiffness = 1000.0
[[output]]
name = "a_p"
kind = "acceleration"
at = "p"
direction = [1.0, 0.0]
[[output]]
name = "a_m"
kind = "acceleration"
at = "m"
direction = [1.0, 0.0]
[[output]]
name = "u_p"
kind = "displacement"
at = "p"
direction = [1.0, 0.0]
)";

verify::Verification verified_swing(const Model& own) {
  const Scene scene = parse_scene(swinging, "test.toml", {{"run.engine", "ida"}, {"run.dt", "2e-3"}});
  verify::VerifyRequest request;
  request.run = scene.run;
  request.dt = scene.run.dt;
  return verify::verify(build_model(scene), own, request);
}

Model swing() { return build_model(parse_scene(swinging, "test.toml", {{"run.engine", "ida"}})); }

const verify::VerifiedKind& kind_of(const verify::Verification& result, const std::string& name) {
  const auto found = std::find_if(result.kinds.begin(), result.kinds.end(),
                                  [&](const verify::VerifiedKind& kind) { return kind.name == name; });
  REQUIRE(found != result.kinds.end());
  return *found;
}

}  // namespace

TEST_SUITE_BEGIN("unit/study/verify/outputs");

TEST_CASE("verify: outputs agree at rows and in their extremes") {
  const verify::Verification result = verified_swing(swing());
  INFO(result.sentence);
  CHECK(result.verdict == verify::Agreement::agree);
  for (const char* name : {"output [m/s^2]", "output [m]"}) {
    CHECK(kind_of(result, name).compared > 150);
    CHECK(*kind_of(result, name).order == doctest::Approx(2.0).epsilon(0.05));
  }
  CHECK(kind_of(result, "output [m/s^2]").compared == 2 * kind_of(result, "output [m]").compared);
  CHECK(kind_of(result, "extremes [m/s^2]").compared == 4);
  CHECK(kind_of(result, "extremes [m]").compared == 2);
}

TEST_CASE("verify: an output that is off in one engine alone is found, and named") {
  for (const std::size_t output : {0U, 2U}) {
    Model own = swing();
    Output& off = own.outputs[output];
    for (Combination* form : {&off.u, &off.a})
      for (auto& term : form->terms) term.second *= output == 0 ? 0.0 : 1.001;
    const verify::Verification result = verified_swing(own);
    INFO(result.sentence);
    CHECK(result.verdict == verify::Agreement::differ);
    CHECK(result.sentence.find(off.name) != std::string::npos);
    CHECK(kind_of(result, output == 0 ? "output [m/s^2]" : "output [m]").disagreeing > 0);
    CHECK(kind_of(result, output == 0 ? "extremes [m/s^2]" : "extremes [m]").disagreeing > 0);
  }
}

TEST_CASE("verify: a reversal at another contact's hit is one of the events") {
  // A block on a belt hits a slope, which turns its slip.
  const Scene scene = parse_scene(R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 0.3
initial = { b = { vx = 0.2, vy = -1.0 } }
[nodes]
b = [0.0, 0.0]
[[masses]]
node = "b"
mass = 1.0
[[contacts]]
name = "belt"
node = "b"
law = "slider"
tangent = [1.0, 0.0]
normal_force = 0.01
friction = 0.3
[[contacts]]
name = "slope"
node = "b"
law = "rigid"
normal = [-0.6, 0.8]
gap = 0.1
restitution = 0.5
friction = 0.0
)",
                                  "test.toml", {{"run.engine", "ida"}, {"run.dt", "1e-3"}});
  // v.n = -0.12 - 0.8 = -0.92 but for the friction's 0.003 N: vx after = 0.2 - 1.5 0.92 0.6 < 0.
  verify::VerifyRequest request;
  request.run = scene.run;
  request.dt = scene.run.dt;
  const Model model = build_model(scene);
  const verify::Verification result = verify::verify(model, model, request);
  INFO(result.sentence);
  const auto turned = [](const verify::VerifiedEvent& event) {
    return event.contact == 0 && event.type == EventType::reversal;
  };
  const auto hits = [](const verify::VerifiedEvent& event) {
    return event.contact == 1 && event.type == EventType::impact;
  };
  REQUIRE(std::count_if(result.events.begin(), result.events.end(), hits) >= 1);
  REQUIRE(std::count_if(result.events.begin(), result.events.end(), turned) == 1);
  const auto turn = std::find_if(result.events.begin(), result.events.end(), turned);
  const auto hit = std::find_if(result.events.begin(), result.events.end(), hits);
  CHECK(turn->time.ida == hit->time.ida);
  CHECK(turn->time.agrees());
}

TEST_SUITE_END();
