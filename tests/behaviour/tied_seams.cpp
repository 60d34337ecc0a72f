// Tied seams: meshes that do not match, joined.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

/// Two blocks, 1 x 0.7 and 1 x 0.5 above, tied, turned; pulled at the top; or one of both. Lowest edge held across, free along.
std::string tied_blocks(const char* low, const char* high, double degrees, const std::string& more) {
  const double a = degrees * std::numbers::pi / 180.0, c = std::cos(a), s = std::sin(a);
  return fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = 0.1, initial = "static" }}
[[bodies]]
name = "low"
rectangle = {{ size = [1.0, 0.7], degrees = {0} }}
elements = [5, 3]
shape = "{1}"
E = 2.0e7
nu = 0.3
density = 1000.0
plane = "stress"
points = {{ corner = [0.0, 0.0] }}
[[bodies]]
name = "high"
rectangle = {{ from = [{3:.17g}, {4:.17g}], size = [1.0, 0.5], degrees = {0} }}
elements = [7, 2]
shape = "{2}"
E = 2.0e7
nu = 0.3
density = 1000.0
plane = "stress"
points = {{ top = [{5:.17g}, {6:.17g}] }}
[[seams]]
name = "joint"
slave = "high.bottom"
master = "low.top"
law = "tied"
{7}
)",
                     degrees, low, high, -0.7 * s, 0.7 * c, -1.2 * s, 1.2 * c, more);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/tied_seams");

TEST_CASE("a constant stress passes a tied seam whose meshes do not match") {
  const char* const pairs[][2] = {{"q4", "q4"}, {"t3", "q4"}, {"q8", "t6"}, {"q4", "q8"}};
  for (const auto& [low, high] : pairs)
    for (const double degrees : {0.0, 33.7}) {
      CAPTURE(low);
      CAPTURE(high);
      CAPTURE(degrees);
      const double a = degrees * std::numbers::pi / 180.0, c = std::cos(a), s = std::sin(a);
      std::string text =
          tied_blocks(low, high, degrees,
                      "[[loads]]\ngroup = \"high.top\"\npressure = -4.0e4\n[[loads]]\ngroup = "
                      "\"low.bottom\"\npressure = -4.0e4\n[[supports]]\nnode = \"corner\"\nfix = "
                      "[\"ux\", \"uy\"]\n");
      // Statically determinate: by moments about the corner the spring bears nothing.
      text += fmt::format(
          "[[springs]]\nnode = \"low.6\"\ndirection = [{:.17g}, {:.17g}]\nstiffness = 1.0e6\n", -s, c);
      const char* const nodes[] = {"corner", "top", "low.8", "high.10", "high.3"};
      int number = 0;
      for (const char* node : nodes) {
        ++number;
        for (const char* q : {"xx", "yy", "xy"})
          text += fmt::format(
              "[[output]]\nname = \"n{0}_{1}\"\nkind = \"stress\"\nat = \"{2}\"\nquantity = "
              "\"{1}\"\ndirection = "
              "[{3:.17g}, {4:.17g}]\n",
              number, q, node, c, s);
      }
      const Scene scene = parse_scene(text, "tied.toml");
      const Model model = build_model(parse_scene(scene.resolved, "run.toml"));
      for (const Output& output : model.outputs) {
        CAPTURE(output.name);
        const double value = output.u.dot(model.u0) + output.constant;
        CHECK(std::abs(value - (output.name.ends_with("yy") ? 4.0e4 : 0.0)) <= 4.0e4 * 1e-9);
      }
    }
}

TEST_CASE("mass, weight and rotation of the whole are kept; a tied beam swings as one of a single mesh") {
  for (const double degrees : {0.0, 21.0}) {
    const Model model = build_model(parse_scene(
        tied_blocks("q8", "q8", degrees, "[[supports]]\nnodes = [\"low.bottom\"]\nfix = [\"ux\", \"uy\"]\n"),
        "tied.toml"));
    const double whole = build_model(parse_scene(fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = 0.1, initial = "static" }}
[[bodies]]
name = "one"
rectangle = {{ size = [1.0, 1.2], degrees = {} }}
elements = [7, 8]
shape = "q8"
E = 2.0e7
nu = 0.3
density = 1000.0
plane = "stress"
[[supports]]
nodes = ["one.bottom"]
fix = ["ux", "uy"]
)",
                                                             degrees),
                                                 "one.toml"))
                             .omega1;
    CHECK(model.omega1 == doctest::Approx(whole).epsilon(2e-3));
  }
  std::string loose = tied_blocks("q4", "t6", 21.0, "");
  loose.erase(loose.find(", initial = \"static\""), std::string(", initial = \"static\"").size());
  const Model free = build_model(parse_scene(loose, "tied.toml"));
  Vector along = Vector::Zero(free.size()), turn = along;
  for (const DrawnNode& n : free.drawn_nodes) {
    if (n.dofs[0] >= free.size() || n.dofs[0] < 0) continue;
    along[n.dofs[0]] = 1.0;
    turn[n.dofs[0]] = -n.y;
    turn[n.dofs[1]] = n.x;
  }
  CHECK(along.dot(free.mass * along) == doctest::Approx(1200.0).epsilon(1e-12));
  CHECK((free.stiffness * along).norm() <= 1e-9 * 2.0e7);
  CHECK((free.stiffness * turn).norm() <= 1e-9 * 2.0e7);
}

TEST_CASE("tied nodes that supports hold, masters at rest, and contact keys are refused") {
  const auto refused = [&](const std::string& more, const std::string& message) {
    CAPTURE(message);
    try {
      static_cast<void>(build_model(parse_scene(tied_blocks("q4", "q4", 0.0, more), "tied.toml")));
      FAIL_CHECK("it was read");
    } catch (const Error& error) {
      const std::string said = error.what();
      CAPTURE(said);
      CHECK(said.find(message) != std::string::npos);
    }
  };
  refused("friction = 0.3\n", "is not allowed with law =");
  refused("[[supports]]\nnodes = [\"high.bottom\"]\nfix = [\"ux\"]\n", "a support fixes the node");
  refused("[[seams]]\nname = \"again\"\nslave = \"low.top\"\nmaster = \"high.bottom\"\nlaw = \"tied\"\n",
          "is itself a tied node");
  refused("[[seams]]\nname = \"down\"\nslave = \"low.bottom\"\nmaster = \"ground\"\nlaw = \"tied\"\n",
          "to a fixed surface");
}

TEST_SUITE_END();
