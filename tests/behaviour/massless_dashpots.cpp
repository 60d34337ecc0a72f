// Contacts with dashpots on nodes without mass, at every angle with the axes.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "signorini/simulate.hpp"

namespace signorini::tests {
namespace {

struct Turned {
  double c, s;
  explicit Turned(double angle) : c(std::cos(angle)), s(std::sin(angle)) {}
  [[nodiscard]] std::string operator()(double x, double y) const {
    return fmt::format("[{:.17g}, {:.17g}]", c * x - s * y, s * x + c * y);
  }
};

/// A mass over a node p without mass, that a load presses on what lies below p: one contact with a dashpot, a slope
/// of two that pull at different angles, or three, of which two are as many as p has motions.
std::string pressed_node(double angle, int contacts) {
  const Turned turned(angle);
  std::string text = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 2.0
[nodes]
m = [0.0, 1.0]
p = [0.0, 0.0]
[[masses]]
node = "m"
mass = 1.0
)";
  const auto spring = [&](const std::string& nodes, double x, double y, double k) {
    text += "[[springs]]\n" + nodes + "direction = " + turned(x, y) + fmt::format("\nstiffness = {}\n", k);
  };
  spring("node = \"m\"\n", 1.0, 0.0, 400.0);
  spring("node = \"m\"\nagainst = \"p\"\n", 0.0, 1.0, 100.0);
  spring("node = \"m\"\nagainst = \"p\"\n", 0.6, 0.8, 30.0);
  spring("node = \"p\"\n", 1.0, 0.0, 50.0);
  const auto contact = [&](const char* name, double x, double y, double gap, double damping,
                           const char* more) {
    text += fmt::format(
        "[[contacts]]\nname = \"{}\"\nnode = \"p\"\nlaw = \"compliant\"\nnormal = {}\ngap = {}\n"
        "normal_stiffness = 1000.0\nnormal_damping = {}\n{}",
        name, turned(x, y), gap, damping, more);
  };
  const char* const rough = "friction = 0.2\ntangential_stiffness = 800.0\ntangential_damping = 0.7\n";
  contact("a", 0.28, 0.96, 0.001, 1.0, contacts == 4 ? rough : "");
  if (contacts > 1) contact("b", -0.6, 0.8, 0.004, 2.0, "");
  if (contacts > 2) contact("c", 0.0, 1.0, 0.009, 0.5, "");
  text += "[[loads]]\nnode = \"m\"\ndirection = " + turned(0.0, -1.0) +
          "\namplitude = 10.0\nhistory = { type = \"step\", start = 0.1 }\n";
  return text;
}

/// A node p without mass on springs of 100 N/m in both directions, which a load throws along the x axis at 0.1 s at a plane
/// that is `angle` from square to the load and 0.05 m away.
std::string thrown_node(double angle, double t_end, const char* run, double load, const char* plane) {
  std::string text = fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
[run]
t_end = {}
{}[nodes]
m = [0.0, 1.0]
p = [0.0, 0.0]
[[masses]]
node = "m"
mass = 1.0
[[contacts]]
name = "plane"
node = "p"
law = "compliant"
normal = {}
gap = 0.05
normal_stiffness = 900.0
{}[[loads]]
node = "p"
direction = [1.0, 0.0]
amplitude = {}
history = {{ type = "step", start = 0.1 }}
)",
                                 t_end, run, Turned(angle)(-1.0, 0.0), plane, load);
  for (const auto& [node, stiffness] : {std::pair{"m", 10.0}, std::pair{"p", 100.0}})
    for (const char* direction : {"[1.0, 0.0]", "[0.0, 1.0]"})
      text += fmt::format("[[springs]]\nnode = \"{}\"\ndirection = {}\nstiffness = {}\n", node, direction,
                          stiffness);
  return text;
}

Result run_of(const std::string& text, const std::string& engine) {
  const std::vector<Override> changes{
      {"run.engine", engine}, {"run.rtol", "1e-10"}, {"run.dt", "2e-4"}, {"run.certify", "false"}};
  const Scene scene = parse_scene(text, "test.toml", changes);
  return simulate(build_model(scene), scene.run);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/massless_dashpots");

TEST_CASE("massless dashpots: a motion turned as a whole has the same events") {
  for (const std::string engine : {"exact", "ida", "newmark"})
    for (const int contacts : {1, 2, 3, 4}) {
      CAPTURE(engine);
      CAPTURE(contacts);
      const Result level = run_of(pressed_node(0.0, contacts), engine);
      INFO(level.report.outcome.reason);
      REQUIRE(level.report.outcome.kind == Outcome::Kind::done);
      CHECK(level.events.size() > 4);
      for (const double angle : {0.3, std::atan2(-0.28, 0.96), 1.0, 1.8, 3.3, -0.7}) {
        CAPTURE(angle);
        const Result turned = run_of(pressed_node(angle, contacts), engine);
        INFO(turned.report.outcome.reason);
        REQUIRE(turned.report.outcome.kind == Outcome::Kind::done);
        REQUIRE(turned.events.size() == level.events.size());
        for (std::size_t i = 0; i < level.events.size(); ++i) {
          CHECK(turned.events[i].contact == level.events[i].contact);
          CHECK(turned.events[i].to == level.events[i].to);
          CHECK(std::abs(turned.events[i].t - level.events[i].t) < (engine == "ida" ? 1e-7 : 1e-10));
        }
      }
    }
}

TEST_CASE("massless dashpots: the approach of a node to an inclined plane, in closed form") {
  // p on springs k I from the ground and a plane with a dashpot: c x' + k x + kn (x - g0) = F along the normal from
  // the touch on, x = g0, which is at once; F/k across it. A load F = 30 along the x axis sets in at 0.1.
  const double k = 100.0, kn = 900.0, c = 25.0, load = 30.0, g0 = 0.05;
  for (const double angle : {0.0, 0.4, 0.9, 1.3})
    for (const std::string engine : {"exact", "ida", "newmark"}) {
      CAPTURE(angle);
      CAPTURE(engine);
      const Result r =
          run_of(thrown_node(angle, 0.3, "output_dt = 0.01\n", load, "normal_damping = 25.0\n"), engine);
      INFO(r.report.outcome.reason);
      REQUIRE(r.report.outcome.kind == Outcome::Kind::done);
      const double along = load * std::cos(angle), across = -load * std::sin(angle) / k;
      for (const Result::Row& row : r.rows) {
        const double t = row.t - 0.1;
        CAPTURE(t);
        const double rest = (along + kn * g0) / (k + kn);
        const double x = t <= 0.0 ? 0.0 : rest + (g0 - rest) * std::exp(-(k + kn) / c * t);
        const double y = t <= 0.0 ? 0.0 : across;
        if (std::abs(t) < 1e-9) continue;  // the rows of the jump
        const double ux = std::cos(angle) * x - std::sin(angle) * y,
                     uy = std::sin(angle) * x + std::cos(angle) * y;
        const double tolerance = engine == "newmark" ? 1e-4 : 1e-9;
        CHECK(std::abs(row.u[2] - ux) < tolerance);
        CHECK(std::abs(row.u[3] - uy) < tolerance);
      }
    }
}

TEST_CASE("massless: a node that a load throws at a rough plane sticks from where it touches") {
  // k x + kn (x - g0) = F cos, k y + kt (y - y0) = F sin, with y0 where it was at the touch: y0/g0 = tan.
  const double k = 100.0, kn = 900.0, kt = 400.0, load = 30.0, g0 = 0.05;
  for (const double angle : {0.0, 0.4, 0.9, -0.7})
    for (const std::string engine : {"exact", "ida", "newmark"}) {
      CAPTURE(angle);
      CAPTURE(engine);
      const Result r =
          run_of(thrown_node(angle, 0.2, "", load, "tangential_stiffness = 400.0\nfriction = 5.0\n"), engine);
      REQUIRE(r.report.outcome.kind == Outcome::Kind::done);
      const double x = (load * std::cos(angle) + kn * g0) / (k + kn);
      const double y = (-load * std::sin(angle) - kt * g0 * std::tan(angle)) / (k + kt);
      const Vector& u = r.rows.back().u;
      CHECK(u[2] == doctest::Approx(std::cos(angle) * x - std::sin(angle) * y).epsilon(1e-9));
      CHECK(u[3] == doctest::Approx(std::sin(angle) * x + std::cos(angle) * y).epsilon(1e-9));
    }
}

TEST_SUITE_END();

}  // namespace signorini::tests
