// Works and dissipations of a stretch against Gauss's rule along the engine's own motion, for every flow.
#include <doctest/doctest.h>

#include "unit/engine/six_masses.hpp"
#include "unit/engine/stretch.hpp"

namespace signorini::tests::works {
namespace {

void check_works(const std::string& text, const std::string& engine, const std::string& flow, double off) {
  CAPTURE(engine);
  CAPTURE(flow);
  Stretch stretch(text, {{"run.engine", engine}, {"run.flow", flow}, {"run.rtol", "1e-9"}});
  REQUIRE(stretch.decision.consistent);
  REQUIRE(stretch.decision.states[0].state == State::slip_plus);
  REQUIRE(stretch.decision.states[1].state == State::stick);
  motion::WorkIntegrals found(3), expected(3);
  long steps = 0;
  const engine::Step last = stretch.go([&](const engine::Step& step) {
    const double middle = step.begin + 0.3 * (step.end - step.begin);
    stretch.engine->dense_output().integrate(step.begin, middle, found);
    stretch.engine->dense_output().integrate(middle, step.end, found);
    stretch.add_powers(step.begin, step.end, engine == "ida" ? 1 : 6, expected);
    ++steps;
  });
  CAPTURE(steps);
  CAPTURE(last.reason);
  REQUIRE(last.kind != engine::Step::Kind::failed);
  REQUIRE(last.end > 0.1);
  CHECK(std::abs(expected.friction[0]) > 0.01);
  CHECK(expected.damping > 0.01);
  CHECK(std::abs(found.loads - expected.loads) < off);
  CHECK(std::abs(found.damping - expected.damping) < off);
  for (std::size_t c = 0; c < 3; ++c) {
    CAPTURE(c);
    CHECK(std::abs(found.friction[c] - expected.friction[c]) < off);
    CHECK(std::abs(found.surface[c] - expected.surface[c]) < off);
    CHECK(std::abs(found.applied_normal_force[c] - expected.applied_normal_force[c]) < off);
  }
}

}  // namespace

TEST_SUITE_BEGIN("unit/engine/works");

TEST_CASE("works along series, in real and in complex modes and of ida's steps are integrals of powers") {
  for (const auto& [engine, flow, off] :
       {std::tuple{"exact", "taylor", 1e-13}, std::tuple{"exact", "modal", 1e-12},
        std::tuple{"ida", "auto", 1e-7}})
    check_works(six_masses(proportional, "", ""), engine, flow, off);
  const std::string dashpot = "normal_damping = 1.5",
                    harmonic = "history = { type = \"harmonic\", omega = 7.0, phase = 0.4 }";
  for (const auto& [engine, flow, off] :
       {std::tuple{"exact", "taylor", 1e-13}, std::tuple{"exact", "modal", 1e-12},
        std::tuple{"ida", "auto", 1e-7}})
    check_works(six_masses(single_dampers, dashpot, harmonic), engine, flow, off);
}

TEST_SUITE_END();

}  // namespace signorini::tests::works
