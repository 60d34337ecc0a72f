// A beam on many contacts, of which each event touches few: decisions near them beside decisions of the whole structure.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "behaviour/scene_parts.hpp"
#include "run/observer.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::long_beam {
namespace {

constexpr int nodes = 420;  // 1260 unknowns: four neighbourhoods and more

/// On compliant contacts with friction, thrown up by pulses that come from left to right; turned as a whole.
std::string scene(double turn) {
  const auto vector = [turn](double x, double y) {
    return fmt::format("[{:.17g}, {:.17g}]", std::cos(turn) * x - std::sin(turn) * y,
                       std::sin(turn) * x + std::cos(turn) * y);
  };
  std::string text =
      parts::head + "gravity = " + vector(0.0, -9.81) +
      "\n[run]\nt_end = 0.012\noutput_dt = 0.004\ninitial = \"static\"\n[damping]\nratios = [0.02, 0.02]\n"
      "frequencies = [1.0, 30.0]\n" +
      parts::section(2.1e6, 2.1e4, 0.1) + "[nodes]\n";
  std::string names;
  for (int i = 0; i < nodes; ++i) {
    text += fmt::format("b{} = {}\n", i, vector(2.0 * i, 0.0));
    names += fmt::format("{}\"b{}\"", i > 0 ? ", " : "", i);
  }
  text += "[[members]]\nnodes = [" + names + "]\nsection = \"s\"\nelements = 1\n";
  for (int i = 0; i < nodes; ++i)
    text += fmt::format(
        "[[contacts]]\nname = \"c{0}\"\nnode = \"b{0}\"\nlaw = \"compliant\"\nnormal = {1}\nnormal_stiffness "
        "= 1e4\n"
        "tangential_stiffness = 1e4\nfriction = {{ static = 0.35, kinetic = 0.3 }}\n",
        i, vector(0.0, 1.0));
  for (int i = 3; i < nodes; i += 9)
    text += fmt::format(
        "[[loads]]\nnode = \"b{}\"\ndirection = {}\namplitude = {}\nhistory = {{ type = \"half_sine\", start "
        "= {}, "
        "duration = 0.006 }}\n",
        i, vector(0.3 * std::sin(1.7 * i), 1.0), 40.0 + 5.0 * (i % 7), 2e-5 * i);
  return text;
}

/// Asks for whole jets, as whoever observes a run does.
class Onlooker final : public MotionObserver {
 public:
  void begin(const ObservedInstant&) override {}
  void step(const ObservedStep&) override {}
  void instant(const ObservedInstant&) override {}
};

}  // namespace

TEST_SUITE_BEGIN("slow/behaviour/long_beam");

TEST_CASE("decisions near the contacts that change are those of the whole structure") {
  for (const char* engine : {"exact", "newmark"})
    for (const double turn : {0.0, 0.3}) {
      CAPTURE(std::string(engine));
      CAPTURE(turn);
      const Scene read = parse_scene(
          scene(turn), "test.toml",
          {{"run.engine", engine}, {"run.flow", "taylor"}, {"run.dt", "1e-4"}, {"run.certify", "false"}});
      const Model model = build_model(read);
      Result near, whole;
      near.report = simulate(model, read.run, near);
      Onlooker onlooker;
      whole.report = simulate(model, read.run, whole, onlooker);
      REQUIRE(near.report.outcome.kind == Outcome::Kind::done);
      CHECK(near.report.witness.violations.empty());
      CHECK(near.report.audit.energy.value < 1e-9 * near.report.audit.energy_scale);
      REQUIRE(near.events.size() == whole.events.size());
      CHECK(near.events.size() > 100);
      for (std::size_t i = 0; i < near.events.size(); ++i) {
        CHECK(near.events[i].contact == whole.events[i].contact);
        CHECK(near.events[i].from == whole.events[i].from);
        CHECK(near.events[i].to == whole.events[i].to);
        CHECK(std::abs(near.events[i].t - whole.events[i].t) <= 1e-12);
      }
    }
}

TEST_CASE("series of exact are no longer than events let them be") {
  const Scene read = parse_scene(scene(0.2), "test.toml",
                                 {{"run.engine", "exact"}, {"run.flow", "taylor"}, {"run.certify", "false"}});
  Result result;
  result.report = simulate(build_model(read), read.run, result);
  const auto events = static_cast<double>(result.events.size());
  REQUIRE(events > 100.0);
  // 30 levels a step reach as far as a series goes; events come before it has gone half of that.
  CHECK(static_cast<double>(result.report.counters.solves) <
        25.0 * static_cast<double>(result.report.counters.steps));
}

TEST_SUITE_END();

}  // namespace signorini::tests::long_beam
