#include <doctest/doctest.h>
#include <fmt/core.h>

#include "decide/driven_states.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

/// Two masses; a slider without a tangential spring on what `tangent` says, its surface moving.
State first_state(const std::string& tangent, const std::string& v, const std::string& surface_velocity) {
  const Model model = build_model(parse_scene(
      fmt::format("schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\n"
                  "[run]\nt_end = 1.0\ninitial = {{ u = [0.0, 0.0], v = [{}] }}\n[matrices]\n"
                  "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[0.0, 0.0], [0.0, 0.0]]\n[[contacts]]\n"
                  "name = \"c\"\nlaw = \"slider\"\nnormal_force = 1.0\nfriction = 0.3\ntangent = {{ {} }}\n"
                  "surface_velocity = {}\n",
                  v, tangent, surface_velocity),
      "test.toml"));
  const motion::Forcing forcing(model, 0.0, motion::Side::after);
  return decide::initial_states(model, forcing, 0.0, model.u0, model.v0)[0].state;
}

}  // namespace

TEST_SUITE_BEGIN("unit/decide/driven_states");

TEST_CASE("a slider starts slipping where its surface leaves it behind, and sticks where it moves along") {
  CHECK(first_state("d0 = 1.0", "0.0, 0.0", "2.0") == State::slip_minus);
  CHECK(first_state("d0 = 1.0", "0.0, 0.0", "-2.0") == State::slip_plus);
  CHECK(first_state("d0 = 1.0", "2.0, 0.0", "2.0") == State::stick);
  CHECK(first_state("d0 = 1.0", "3.0, 0.0", "2.0") == State::slip_plus);
}

TEST_CASE("velocities that are equal but for a rounding are no slip") {
  CHECK(first_state("d0 = 1.0, d1 = -1.0", "0.3, 0.30000000000000004", "0.0") == State::stick);
  CHECK(first_state("d0 = 1.0, d1 = -1.0", "0.30000000000000004, 0.3", "0.0") == State::stick);
  CHECK(first_state("d0 = 1.0, d1 = -1.0", "0.3, 0.301", "0.0") == State::slip_minus);
}

TEST_SUITE_END();
