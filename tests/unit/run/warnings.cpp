#include "run/warnings.hpp"

#include <doctest/doctest.h>

#include "contact/contact_states.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

Audit audit(double off, double exchanged) {
  Audit a;
  a.energy.value = off;
  a.energy_scale = exchanged;
  return a;
}

bool has_word(const std::string& text, const std::string& word) {
  return text.find(word) != std::string::npos;
}

}  // namespace

TEST_SUITE_BEGIN("unit/run/warnings");

TEST_CASE("a balance is off beside what was exchanged, and beside the rounding of what is stored") {
  Method ida, exact;
  exact.engine = Engine::exact;
  CHECK_FALSE(run::energy_warning(audit(1e-4, 1.0), ida, 0.0, true));
  CHECK_FALSE(run::energy_warning(audit(2.8, 1e-8), ida, 10.0, true));
  const auto more = run::energy_warning(audit(2.8, 1e-8), ida, 1.0, true);
  REQUIRE(more);
  CHECK(has_word(*more, "2.8, more than the exchanged energy (1e-08)"));
  const auto lost = run::energy_warning(audit(0.5, 2.0), ida, 0.0, true);
  REQUIRE(lost);
  CHECK(has_word(*lost, "0.25 of the exchanged energy"));
  CHECK(has_word(*lost, "engine \"exact\""));
  CHECK_FALSE(has_word(*run::energy_warning(audit(0.5, 2.0), ida, 0.0, false), "exact"));
  CHECK_FALSE(has_word(*run::energy_warning(audit(0.5, 2.0), exact, 0.0, true), "engine \"exact\""));
}

TEST_CASE(
    "a shear is cut where the limit is below it by more than the rounding of what N is a difference of") {
  Model model;
  model.units = {"N", "kg", "m", "s"};
  Contact c;
  c.name = "shoe";
  c.normal.terms = {{0, 1.0}, {1, 1.0}};
  c.normal_stiffness = 5e4;
  c.friction.static_ = c.friction.kinetic = 0.3;
  model.u0 = Eigen::Vector2d(1.0, -1.0 - 2e-4);  // N = -10, of terms of 5e4
  decide::Decision start;
  start.visited = start.jumped = {true};
  start.after.resize(1);
  start.after[0].T = 3.0;
  const auto told = [&](double asked) {
    c.initial_shear = asked;
    model.contacts = {c};
    model.layout = contact::layout_of(model.contacts);
    return run::shear_limit_warnings(model, start);
  };
  // 64 eps 0.3 5e4 (1 + 1 + 2e-4) = 4.3e-10
  CHECK(told(3.0 + 4.2e-10).empty());
  REQUIRE(told(3.0 + 4.4e-10).size() == 1);
  CHECK(
      has_word(told(3.5)[0], "initial_shear = 3.5 N is above the friction limit at t = 0; T starts at 3 N"));
  start.jumped = {false};
  CHECK(told(3.5).empty());
}

TEST_CASE(
    "a long beam at rest, unloaded, loses nothing: its energies are differences of far greater numbers") {
  const Scene scene = parse_scene(R"(schema = 1
units = { force = "kN", mass = "t", length = "m", time = "s" }
gravity = [0.0, -9.81]
[run]
t_end = 0.02
initial = "static"
engine = "ida"
[sections.pipe]
EA = 6.0e5
EI = 2.0e3
mass_per_length = 0.06
[[lines]]
name = "P"
from = [0.0, 0.0]
to = [2000.0, 0.0]
pieces = 3999
[[members]]
nodes = ["P0..P3999"]
section = "pipe"
[[supports]]
node = "P0"
fix = ["ux"]
[[contacts]]
name = "shoe"
nodes = ["P2..P3593:399"]
law = "compliant"
normal = [0.0, 1.0]
normal_stiffness = 5e4
tangential_stiffness = 5e4
friction = 0.3
)",
                                  "still.toml");
  const Result run = simulate(scene);
  CHECK(run.report.outcome.kind == Outcome::Kind::done);
  for (const std::string& warning : run.report.warnings) {
    CAPTURE(warning);
    CHECK_FALSE(has_word(warning, "energy balance"));
  }
}

TEST_SUITE_END();
