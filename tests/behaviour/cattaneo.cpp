// A line contact under a shear that goes to and fro: the closed forms of Cattaneo and Mindlin, node by node.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "behaviour/mapped_mesh.hpp"
#include "signorini/simulate.hpp"
#include "unit/result/made_up.hpp"

using namespace signorini;

namespace {

/// Depth of n layers of elements, the first h, each 1.2 times the one before.
double layers(double h, double n) { return h * (std::pow(1.2, n) - 1.0) / 0.2; }

/// Steps of one up to 1.1 times `even`, then growing by 1.25.
double graded_place(double steps, double even) {
  const double inside = std::min(steps, 1.1 * even);
  const double rest = steps - inside;
  return inside + (std::pow(1.25, rest) - 1.0) / std::log(1.25);
}

/// Two half-planes of one material, the upper one x^2/(2 R) high, turned together by `turn`.
struct LineContact {
  double q = 0.6, turn = 0.0;
  double E = 1000.0, nu = 0.3, R = 1.0, a = 0.02, friction = 0.3, omega = 0.5;
  double even = 20.0;  ///< elements on a
  int across = 24;

  [[nodiscard]] double stiffness() const { return E / (2.0 * (1.0 - nu * nu)); }  ///< 1/E* = 2 (1 - nu^2)/E
  [[nodiscard]] double force() const { return std::numbers::pi * stiffness() * a * a / (4.0 * R); }
  [[nodiscard]] double peak() const { return 2.0 * force() / (std::numbers::pi * a); }
  [[nodiscard]] double stuck() const { return a * std::sqrt(1.0 - q); }
  [[nodiscard]] double period() const { return 2.0 * std::numbers::pi / omega; }
  [[nodiscard]] std::array<double, 2> turned(double x, double y) const {
    return {x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn)};
  }

  [[nodiscard]] double pressure(double x) const { return peak() * std::sqrt(1.0 - x * x / (a * a)); }
  [[nodiscard]] double shear(double x) const {
    const double c = stuck(), inner = std::abs(x) < c ? std::sqrt(1.0 - x * x / (c * c)) : 0.0;
    return friction * (pressure(x) - peak() * c / a * inner);
  }
  /// Between -Q and Q: twice the slip of the first loading, whose slope is f/R sqrt(x^2 - c^2).
  [[nodiscard]] double slip(double x) const {
    const double c = stuck(), r = std::abs(x);
    if (r <= c) return 0.0;
    return friction / R * (r * std::sqrt(r * r - c * c) - c * c * std::acosh(r / c));
  }
  [[nodiscard]] double loss() const {
    return 4.0 * std::pow(friction * force(), 2) / (std::numbers::pi * stiffness()) *
           ((1.0 - q) * std::log(1.0 - q) + q - 0.5 * q * q);
  }

  /// Finest at the contact, where the upper body has `even` elements on a, the lower one 3 more.
  [[nodiscard]] std::string mesh(bool up) const {
    const double fine = up ? even : even + 3.0, h = a / fine;
    const int side = static_cast<int>(1.1 * fine) + 20;
    return test::mapped_mesh(PlaneShape::q4, 2 * side, across, [=, this](double s, double b) {
      const double steps = (2.0 * s - 1.0) * side;
      const double x = std::copysign(h * graded_place(std::abs(steps), fine), steps);
      if (!up) return turned(x, -layers(h, (1.0 - b) * across));
      const double off = layers(h, b * across);
      return turned(x, off + (1.0 - off / layers(h, across)) * x * x / (2.0 * R));
    });
  }
  [[nodiscard]] std::string scene(const std::string& folder) const {
    const auto top = turned(0.0, layers(a / even, across)), down = turned(0.0, -1.0),
               along = turned(1.0, 0.0);
    return fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = {0:.17g}, output_times = [{1:.17g}, {2:.17g}, {0:.17g}], engine = "exact", initial = "static", certify = false }}
damping = {{ alpha = 20.0, beta = 0.0 }}
reduction = {{ cutoff_omega = 1.0 }}
[[bodies]]
name = "low"
mesh = "{3}/low.msh"
E = {4}
nu = {5}
density = 1.0
plane = "strain"
[[bodies]]
name = "high"
mesh = "{3}/high.msh"
E = {4}
nu = {5}
density = 1.0
plane = "strain"
[[rigid]]
name = "head"
nodes = ["high.top"]
centre = [{6:.17g}, {7:.17g}]
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
direction = [{8:.17g}, {9:.17g}]
amplitude = {10:.17g}
history = {{ type = "constant" }}
[[loads]]
node = "head"
direction = [{11:.17g}, {12:.17g}]
amplitude = {13:.17g}
history = {{ type = "harmonic", omega = {14} }}
[[seams]]
name = "joint"
slave = "high.bottom"
master = "low.top"
law = "compliant"
normal_stiffness = {15:.17g}
tangential_stiffness = {15:.17g}
friction = {16}
contact_mass = "none"
)",
                       1.25 * period(), 0.25 * period(), 0.75 * period(), folder, E, nu, top[0], top[1],
                       down[0], down[1], force(), along[0], along[1], q * friction * force(), omega,
                       1000.0 * E / a, friction);
  }
  [[nodiscard]] Scene read() const {
    const made_up::Folder folder;
    made_up::spill(folder / "low.msh", mesh(false));
    made_up::spill(folder / "high.msh", mesh(true));
    return parse_scene(scene((folder / "low.msh").parent_path().string()), "cattaneo.toml");
  }
};

/// Tractions at the first +Q, slips from there to -Q, at all nodes but those next to a and c, where they have kinks.
void check_nodes(const LineContact& line, const Scene& scene, const Result& result) {
  const SeamSpec& seam = scene.seams.front();
  const double h = line.a / line.even, p0 = line.peak(), most = line.slip(line.a);
  int touching = 0;
  double N = 0.0, stick = 0.0, closed = 0.0;
  for (std::size_t k = 0; k < seam.nodes.size(); ++k) {
    const ContactSample& c = result.rows[0].contacts[seam.first_contact + k];
    const ContactSample& turned_back = result.rows[1].contacts[seam.first_contact + k];
    const Node& node = scene.nodes[static_cast<std::size_t>(seam.nodes[k].node)];
    const double x = node.x * std::cos(line.turn) + node.y * std::sin(line.turn);
    const double D = seam.nodes[k].length;
    N -= c.N;
    if (is_open(c.state)) continue;
    ++touching;
    closed += D;
    if (kind_of(c.state) == State::stick) stick += D;
    if (std::abs(x) > line.a - 1.5 * h) continue;
    CAPTURE(x / line.a);
    CHECK(std::abs(-c.N / D - line.pressure(x)) <= 0.015 * p0);
    CHECK(std::abs(std::abs(c.slip - turned_back.slip) - line.slip(x)) <= 0.01 * most);
    if (std::abs(std::abs(x) - line.stuck()) > 1.5 * h)
      CHECK(std::abs(std::abs(c.T) / D - line.shear(x)) <= 0.015 * line.friction * p0);
  }
  CHECK(touching >= 30);
  CHECK(std::abs(N / line.force() - 1.0) <= 1e-3);
  CHECK(std::abs(0.5 * closed - line.a) <= h);
  CHECK(std::abs(0.5 * stick - line.stuck()) <= h);
}

}  // namespace

TEST_SUITE_BEGIN("slow/behaviour/cattaneo");

TEST_CASE(
    "alike half-planes under a shear to and fro: tractions and slips at nodes, loss of a loop within 2 %") {
  for (const auto& [q, turn] : {std::pair{0.5, 0.0}, std::pair{0.6, 0.4}, std::pair{0.8, -2.3}}) {
    CAPTURE(q);
    const LineContact line{.q = q, .turn = turn};
    const Scene scene = line.read();
    const Result result = simulate(scene);
    REQUIRE(result.rows.size() == 3);
    check_nodes(line, scene, result);
    const double loss = result.rows[2].energy.friction - result.rows[0].energy.friction;
    CHECK(std::abs(loss / line.loss() - 1.0) <= 0.02);
  }
}

TEST_SUITE_END();
