// Where a run leaves the range of small motions.
#include "run/run_limits.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "contact/contact_states.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

/// Of a body that spins freely from the angle zero.
std::vector<std::string> warnings_of(double spin, double t_end) {
  const std::string text =
      "schema = 1\nunits = { force = \"kN\", mass = \"t\", length = \"m\", time = \"s\" }\n[run]\nt_end = " +
      std::to_string(t_end) + "\nengine = \"ida\"\ninitial = { C = { rz = 0.0, wz = " + std::to_string(spin) +
      " } }\n[nodes]\nL = [0.0, 0.0]\nR = [1.0, 0.2]\n[[rigid]]\nname = \"C\"\ncentre = [0.5, 0.1]\n"
      "nodes = [\"L\", \"R\"]\nmass = 1.0\ninertia = 0.1\n";
  const Scene scene = parse_scene(text, "test.toml");
  return simulate(build_model(scene), scene.run).report.warnings;
}

bool tells(const std::vector<std::string>& warnings, const std::string& what) {
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const std::string& w) { return w.find(what) != std::string::npos; });
}

}  // namespace

TEST_SUITE_BEGIN("unit/run/large_motions");

TEST_CASE("a rotation beyond a quarter is told, with the greatest; a smaller one is not") {
  CHECK_FALSE(tells(warnings_of(1.0, 0.24), "assumes small rotations"));
  const std::vector<std::string> far = warnings_of(1.0, 2.0);
  CHECK(tells(far, "assumes small rotations"));
  CHECK(tells(far, "reaches 2 rad"));
  CHECK(tells(warnings_of(-1.0, 2.0), "reaches 2 rad"));
}

TEST_CASE("of pendulums ut beyond a quarter of the radius counts, and amplitudes of modes do not") {
  Model model;
  model.dofs.push_back({"A.ux", "A.vx", false, false});
  model.u0 = model.v0 = Vector::Zero(1);
  Contact contact;
  contact.name = "p";
  contact.tangent.terms = {{0, 1.0}};
  contact.pendulum_surface = CurvedSurface{};
  contact.pendulum_surface->radius = 2.0;
  model.contacts.push_back(contact);
  model.layout = contact::layout_of(model.contacts);
  model.unit = {1.0, 1.0, 4.0};
  const motion::Forcing forcing = motion::Forcing::none(model);
  const auto told = [&](double u) {
    run::LargeMotionDetector large(model);
    large.examine(0.5, forcing, {Vector::Constant(1, u), Vector::Zero(1), Vector::Zero(2)});
    return large.warning();
  };
  CHECK_FALSE(told(0.49));
  REQUIRE(told(-0.6));
  CHECK(told(-0.6)->find("ut / R of contact 'p' is 0.3 rad at t = 2") == 0);
  model.contacts[0].pendulum_surface.reset();
  CHECK_FALSE(told(-0.6));
  model.dofs[0].rotation = true;
  CHECK(told(-0.6));
  model.reduction.emplace();
  CHECK_FALSE(told(-0.6));
}

TEST_SUITE_END();
