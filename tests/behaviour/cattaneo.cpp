// A line contact under a shear that goes to and fro: loss and stick zone of Cattaneo and Mindlin.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "behaviour/mapped_mesh.hpp"
#include "signorini/simulate.hpp"
#include "unit/result/made_up.hpp"

using namespace signorini;

namespace {

/// Steps of one up to 1.1 times `even`, then growing by 1.25.
double graded_place(double steps, double even) {
  const double inside = std::min(steps, 1.1 * even);
  const double rest = steps - inside;
  return inside + (std::pow(1.25, rest) - 1.0) / std::log(1.25);
}

struct LineContact {
  double E = 1000.0, nu = 0.3, R = 1.0, a = 0.02, friction = 0.3, q = 0.6, omega = 0.5;
  [[nodiscard]] double stiffness() const { return E / (2.0 * (1.0 - nu * nu)); }  ///< 1/E' = 2 (1 - nu^2)/E
  [[nodiscard]] double force() const { return std::numbers::pi * stiffness() * a * a / (4.0 * R); }
  [[nodiscard]] double period() const { return 2.0 * std::numbers::pi / omega; }

  /// even: elements on the half width of the contact; up: above or below it.
  [[nodiscard]] std::string mesh(double even, bool up) const {
    const int side = static_cast<int>(1.1 * even) + 20, across = 24;
    const double h = a / even;
    return test::mapped_mesh(PlaneShape::q4, 2 * side, across, [=, this](double s, double b) {
      const double steps = (2.0 * s - 1.0) * side;
      const double x = std::copysign(h * graded_place(std::abs(steps), even), steps);
      const double off = h * (std::pow(1.2, b * across) - 1.0) / 0.2,
                   depth = h * (std::pow(1.2, across) - 1.0) / 0.2;
      if (!up) return std::array{x, off - depth};
      return std::array{x, off + (1.0 - off / depth) * x * x / (2.0 * R)};
    });
  }
  [[nodiscard]] std::string scene(const std::string& folder, double height) const {
    return fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = {0:.17g}, output_times = [{1:.17g}, {0:.17g}], engine = "exact", initial = "static", certify = false }}
damping = {{ alpha = 20.0, beta = 0.0 }}
reduction = {{ cutoff_omega = 1.0 }}
[[bodies]]
name = "low"
mesh = "{2}/low.msh"
E = {3}
nu = {4}
density = 1.0
plane = "strain"
[[bodies]]
name = "high"
mesh = "{2}/high.msh"
E = {3}
nu = {4}
density = 1.0
plane = "strain"
[[rigid]]
name = "head"
nodes = ["high.top"]
centre = [0.0, {5:.17g}]
mass = 0.01
inertia = 1.0e-3
[[supports]]
node = "head"
fix = ["rz"]
[[supports]]
nodes = ["low.bottom"]
fix = ["ux", "uy"]
[[loads]]
node = "head"
direction = [0.0, -1.0]
amplitude = {6:.17g}
history = {{ type = "constant" }}
[[loads]]
node = "head"
direction = [1.0, 0.0]
amplitude = {7:.17g}
history = {{ type = "harmonic", omega = {8} }}
[[seams]]
name = "joint"
slave = "high.bottom"
master = "low.top"
law = "compliant"
normal_stiffness = {9:.17g}
tangential_stiffness = {9:.17g}
friction = {10}
contact_mass = "none"
)",
                       1.25 * period(), 0.25 * period(), folder, E, nu, height, force(),
                       q * friction * force(), omega, 1000.0 * E / a, friction);
  }
};

}  // namespace

TEST_SUITE_BEGIN("slow/behaviour/cattaneo");

TEST_CASE("alike half-planes under a shear q f P: loss of a loop within 2 %, half width of the stick zone") {
  const LineContact line;
  const made_up::Folder folder;
  made_up::spill(folder / "low.msh", line.mesh(13.0, false));
  made_up::spill(folder / "high.msh", line.mesh(16.0, true));
  const double height = line.a / 16.0 * (std::pow(1.2, 24) - 1.0) / 0.2;
  const Scene scene =
      parse_scene(line.scene((folder / "low.msh").parent_path().string(), height), "cattaneo.toml");
  const Result result = simulate(scene);
  REQUIRE(result.rows.size() >= 2);
  const auto& first = result.rows.front();
  const auto& last = result.rows.back();
  const SeamSpec& seam = scene.seams.front();
  double N = 0.0, stick = 0.0, closed = 0.0;
  int touching = 0;
  for (std::size_t k = 0; k < seam.nodes.size(); ++k) {
    const ContactSample& c = first.contacts[seam.first_contact + k];
    N -= c.N;
    if (is_open(c.state)) continue;
    ++touching;
    closed += seam.nodes[k].length;
    if (kind_of(c.state) == State::stick) stick += seam.nodes[k].length;
  }
  const double P = line.force(), q = line.q, f = line.friction, a = line.a, h = line.a / 16.0;
  CHECK(touching >= 30);
  CHECK(N == doctest::Approx(P).epsilon(1e-3));
  CHECK(std::abs(0.5 * closed - a) <= h);
  CHECK(std::abs(0.5 * stick - a * std::sqrt(1.0 - q)) <= h);
  const double loss = 4.0 * f * f * P * P / (std::numbers::pi * line.stiffness()) *
                      ((1.0 - q) * std::log(1.0 - q) + q - 0.5 * q * q);
  MESSAGE("loss " << (last.energy.friction - first.energy.friction) / loss << " of the closed form, "
                  << result.events.size() << " events, stick " << 0.5 * stick / a << ", closed "
                  << 0.5 * closed / a);
  CHECK(last.energy.friction - first.energy.friction == doctest::Approx(loss).epsilon(0.02));
}

TEST_SUITE_END();
