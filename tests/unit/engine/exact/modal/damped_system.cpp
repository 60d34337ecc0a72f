// Dampers beside Rayleigh's damping are found at every angle of the scene, and where every datum is off by a rounding.
#include "engine/exact/modal/damped_system.hpp"

#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <string>

#include "behaviour/scene_parts.hpp"
#include "certify/data_perturbation.hpp"
#include "signorini/scene.hpp"

using namespace signorini;
using namespace signorini::tests::parts;

namespace {

/// A cantilever of a stiff section, turned; dampers of springs at its tip and in its middle, not along it.
std::string cantilever(double angle, int dampers) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto at = [&](double x, double y) {
    return fmt::format("[{:.17g}, {:.17g}]", c * x - s * y, s * x + c * y);
  };
  std::string text = head + run_table(1.0, 0.5) +
                     "[damping]\nalpha = 0.58\nbeta = 1e-3\n[nodes]\nA = " + at(0.0, 0.0) +
                     "\nB = " + at(5.0, 0.0) + "\nC = " + at(9.0, 1.0) + "\n" + section(1.3e6, 1.6e5, 0.3) +
                     member("A, B, C", "elements = 5\n") + fixed("A", "ux, uy, rz");
  for (int i = 0; i < dampers; ++i)
    text += spring(i == 0 ? "C" : "B", at(i == 0 ? 0.3 : 0.0, 1.0), 171.0) +
            fmt::format("damping = {}\n", i == 0 ? 0.14 : 0.02);
  return text;
}

}  // namespace

TEST_SUITE("unit/engine/exact/modal/damped_system") {
  TEST_CASE("as many dampers as the scene has, turned and with every datum off by a rounding") {
    for (int turn = 0; turn < 40; ++turn)
      for (const int dampers : {0, 1, 2}) {
        const double angle = 0.1571 * turn;
        CAPTURE(angle);
        CAPTURE(dampers);
        const Model model = build_model(parse_scene(cantilever(angle, dampers), "test.toml"));
        CHECK(modal::damped_refusal(model) == "");
        CHECK(modal::max_state_terms(model) == static_cast<std::size_t>(dampers));
        for (const std::uint64_t seed : {1u, 2u, 3u}) {
          const Model near = certify::perturbed(model, seed);
          CHECK(modal::damped_refusal(near) == "");
          CHECK(modal::max_state_terms(near) == static_cast<std::size_t>(dampers));
        }
      }
  }
}
