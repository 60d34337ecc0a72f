// Benchmarks of plane continua: Cook's membrane, the line contact of Hertz.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "behaviour/mapped_mesh.hpp"
#include "signorini/simulate.hpp"
#include "unit/result/made_up.hpp"

using namespace signorini;

namespace {

/// Cook, Finite Element Modeling for Stress Analysis (1995): 48 wide, 44 high at its left end, 16 at its right one.
double cooks_deflection(PlaneShape shape, const char* name, int n) {
  const made_up::Folder folder;
  made_up::spill(folder / "cook.msh", test::mapped_mesh(shape, n, n, [](double a, double b) {
                   return std::array{48.0 * a, 44.0 * a + b * (44.0 - 28.0 * a)};
                 }));
  const Model model = build_model(parse_scene(fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = 1.0, initial = "static" }}
[[bodies]]
name = "cook"
mesh = "{}"
E = 1.0
nu = 0.33333333333333333
density = 1.0
plane = "stress"
points = {{ middle = [48.0, 52.0] }}
[[supports]]
nodes = ["cook.left"]
fix = ["ux", "uy"]
[[loads]]
group = "cook.right"
traction = 0.0625
direction = [0.0, 1.0]
)",
                                                          (folder / "cook.msh").string()),
                                              name));
  for (int i = 0; i < model.size(); ++i)
    if (model.dofs[static_cast<std::size_t>(i)].displacement == "middle.uy") return model.u0[i];
  FAIL("no displacement");
  return 0.0;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/plane_benchmarks");

TEST_CASE("Cook's membrane: the deflection of the middle of its end goes to 23.97") {
  // Converged by others: 23.96 to 23.97 (Bergan and Felippa 1985; Simo and Rifai 1990).
  const double quadratic = cooks_deflection(PlaneShape::q8, "q8", 16);
  CHECK(quadratic == doctest::Approx(23.965).epsilon(0.002));
  CHECK(std::abs(quadratic - 23.965) <= 0.5 * std::abs(cooks_deflection(PlaneShape::q8, "q8", 8) - 23.965));
  const double coarse = cooks_deflection(PlaneShape::q4, "q4", 8),
               fine = cooks_deflection(PlaneShape::q4, "q4", 16);
  CHECK(coarse == doctest::Approx(23.965).epsilon(0.03));
  CHECK(fine == doctest::Approx(23.965).epsilon(0.01));
  CHECK(std::abs(fine - 23.965) <= 0.5 * std::abs(coarse - 23.965));
}

TEST_CASE("line contact of Hertz: pressure and half width within 1 %") {
  // Half of an elastic block on a rigid cylinder: p = p0 sqrt(1 - x^2/a^2), p0 = sqrt(P E' / (pi R)),
  // a^2 = 4 P R / (pi E'), E' = E / (1 - nu^2).
  const double R = 1.0, a = 0.02, E = 1000.0, nu = 0.3, width = 0.3;
  const double stiff = E / (1.0 - nu * nu), P = std::numbers::pi * stiff * a * a / (4.0 * R);
  const double p0 = 2.0 * P / (std::numbers::pi * a);
  const Scene scene = parse_scene(fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = 1.0, initial = "static" }}
[[bodies]]
name = "block"
rectangle = {{ size = [{0}, {0}] }}
elements = [48, 40]
grading = [9.3, 9.7]
shape = "q4"
E = {1}
nu = {2}
density = 1.0
plane = "strain"
[[bodies]]
name = "cylinder"
ring = {{ centre = [0.0, -1.00001], inner = 0.9, outer = 1.0, degrees = [70.0, 90.0] }}
elements = [1, 40]
shape = "q8"
E = 1.0e6
nu = 0.3
density = 1.0
plane = "strain"
[[supports]]
nodes = ["cylinder"]
fix = ["ux", "uy"]
[[supports]]
nodes = ["block.left"]
fix = ["ux"]
[[loads]]
group = "block.top"
pressure = {3:.17g}
[[seams]]
name = "contact"
slave = "block.bottom"
master = "cylinder.outer"
law = "rigid"
)",
                                              width, E, nu, 0.5 * P / width),
                                  "hertz.toml");
  const Model model = build_model(scene);
  const SeamSpec& seam = scene.seams.front();
  double total = 0.0, n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0, middle = 0.0;
  for (std::size_t k = 0; k < seam.nodes.size(); ++k) {
    const double N = model.statics.reactions[seam.first_contact + k], p = N / seam.nodes[k].length;
    const double x = scene.nodes[static_cast<std::size_t>(seam.nodes[k].node)].x;
    total += N;
    if (x == 0.0) middle = p;
    if (x > 0.9 * a) continue;
    n += 1.0, sx += x * x, sy += p * p, sxx += x * x * x * x, sxy += x * x * p * p;
  }
  CHECK(std::abs(total / (0.5 * P) - 1.0) <= 1e-9);
  // p^2 = p0^2 (1 - x^2/a^2) by least squares.
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx), at_zero = (sy - slope * sx) / n;
  CAPTURE(middle / p0);
  CAPTURE(std::sqrt(at_zero) / p0);
  CAPTURE(std::sqrt(-at_zero / slope) / a);
  CHECK(std::abs(middle / p0 - 1.0) <= 0.01);
  CHECK(std::abs(std::sqrt(at_zero) / p0 - 1.0) <= 0.01);
  CHECK(std::abs(std::sqrt(-at_zero / slope) / a - 1.0) <= 0.01);
}

TEST_SUITE_END();
