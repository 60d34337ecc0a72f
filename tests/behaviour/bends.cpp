// Members that are arcs: a quarter of a circle against the sum over its chords and against the arc, factors of bends.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "behaviour/outputs.hpp"
#include "study/check/check.hpp"

namespace signorini::tests::bends {

using namespace outputs;

namespace {

constexpr double EI = 700.0, EA = 9e4, force = 3.0;

/// A quarter of a circle of radius R, clamped at A; at B a force along the radius. The centre is at a place of its own.
struct Quarter {
  double R = 1.3, turn = 0.0;
  int elements = 8;
  std::string factors = {}, more = {};
  bool mirrored = false, backwards = false;
  std::string section =
      fmt::format("EA = {}\nEI = {}\nmass_per_length = 0.0\narea = 0.02\nmodulus = 0.001", EA, EI);

  [[nodiscard]] std::string at(double angle, double length, double x0 = 0.0, double y0 = 0.0) const {
    const double x = length * std::cos(angle), y = (mirrored ? -1.0 : 1.0) * length * std::sin(angle);
    return fmt::format("[{:.17g}, {:.17g}]", x0 + std::cos(turn) * x - std::sin(turn) * y,
                       y0 + std::sin(turn) * x + std::cos(turn) * y);
  }
  [[nodiscard]] std::string text() const {
    const bool left = mirrored == backwards;  // from A to B the angle grows
    return fmt::format(R"(schema = 1
units = {{ force = "kN", mass = "t", length = "m", time = "s" }}
[run]
t_end = 0.1
initial = "static"
[sections.s]
{}
[nodes]
A = {}
B = {}
[[masses]]
node = "B"
mass = 0.1
[[members]]
nodes = {}
section = "s"
mass = "lumped"
bend = {{ radius = {:.17g}{} }}
elements = {}
[[supports]]
node = "A"
fix = ["ux", "uy", "rz"]
[[loads]]
node = "B"
direction = {}
amplitude = {:.17g}
{})",
                       section, at(0.0, R, 2.0, -1.0), at(M_PI / 2.0, R, 2.0, -1.0),
                       backwards ? "[\"B\", \"A\"]" : "[\"A\", \"B\"]", left ? R : -R, factors, elements,
                       at(M_PI / 2.0, 1.0), force,
                       output("u", "displacement", "at = \"B\"\ndirection = " + at(M_PI / 2.0, 1.0)) + more);
  }
  /// By virtual work: sum over the chords of integrals of M^2/EI and N^2/EA; M = F R sin(angle from B) at nodes.
  [[nodiscard]] double by_chords(double flexibility = 1.0) const {
    const double half = M_PI / 4.0 / elements, length = 2.0 * R * std::sin(half);
    double sum = 0.0;
    for (int i = 0; i < elements; ++i) {
      const double a = force * R * std::sin(2.0 * half * i), b = force * R * std::sin(2.0 * half * (i + 1));
      const double N = force * std::sin(2.0 * half * (i + 0.5));
      sum += flexibility * length / (3.0 * EI) * (a * a + a * b + b * b) + N * N * length / EA;
    }
    return sum / force;
  }
  [[nodiscard]] double by_arc() const { return force * M_PI / 4.0 * (R * R * R / EI + R / EA); }
};

void close(double value, double expected, double relative) {
  CHECK(std::abs(value - expected) <= relative * std::abs(expected));
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/bends");

TEST_CASE("a quarter of a circle: the sum over its chords, to 1e-10, and the arc with order two") {
  double before = 0.0;
  for (const int n : {4, 8, 16, 32}) {
    Quarter q;
    q.elements = n;
    const double u = compute(q.text()).last("u");
    close(u, q.by_chords(), 1e-10);
    const double error = std::abs(u - q.by_arc());
    if (before > 0.0) CHECK(before / error == doctest::Approx(4.0).epsilon(0.02));
    before = error;
  }
  CHECK(before < 1e-3 * Quarter().by_arc());
}

TEST_CASE("a bend turned, mirrored, the other way round: the same, and its moment on the other side") {
  for (const bool mirrored : {false, true})
    for (const bool backwards : {false, true})
      for (const double turn : {0.0, 0.4321, 2.9}) {
        Quarter q;
        q.mirrored = mirrored;
        q.backwards = backwards;
        q.turn = turn;
        q.elements = 5;
        q.factors = ", flexibility = 3.5, sif = 2.25";
        q.more =
            cut("M", "M", 0.0) + cut("mid", "M", 0.4) +
            output("s", "stress", "at = [\"A\", \"B\"]\nquantity = \"M\"\nfibre = \"left\"") +
            output("plain", "stress", "at = [\"A\", \"B\"]\nquantity = \"M\"\nfibre = \"left\"\nsif = 1.0") +
            output("e", "envelope", "nodes = [\"A\", \"B\"]\nquantity = \"stress\"");
        const Computed c = compute(q.text());
        close(c.last("u"), q.by_chords(3.5), 1e-10);
        // The force pulls outwards at B: it opens the bend at A, stretching its inner side, left of a way that turns left.
        const double M = (mirrored ? 1.0 : -1.0) * force * 1.3;
        close(c.last("M"), M, 1e-10);
        close(c.last("mid"), M * std::sin(0.6 * M_PI / 2.0), 1e-10);
        close(c.last("s"), -2.25 * M / 0.001, 1e-10);
        close(c.last("plain"), -M / 0.001, 1e-10);
        // greatest at A, N of the first chord included
        const double N = force * std::sin(0.9 * M_PI / 2.0) / 0.02;
        close(c.extremes("e").maximum, N + 2.25 * force * 1.3 / 0.001, 1e-10);
        CHECK(c.extremes("e").at_maximum.station < 1e-9);
      }
}

TEST_CASE("a bend of a pipe: flexibility and intensification by the printed formula") {
  Quarter q;
  q.section = "pipe = { diameter = 0.2, wall = 0.006, E = 2e8, density = 0.0 }";
  q.more = output("s", "stress", "at = [\"A\", \"B\"]\nquantity = \"M\"\nfibre = \"right\"") +
           output("plain", "stress", "at = [\"A\", \"B\"]\nquantity = \"M\"\nfibre = \"right\"\nsif = 1.0");
  const double r = 0.097, h = 0.006 * 1.3 / (r * r);
  const Computed c = compute(q.text());
  q.factors = fmt::format(", flexibility = {:.17g}, sif = {:.17g}", 1.65 / h, 0.9 / std::pow(h, 2.0 / 3.0));
  const Computed given = compute(q.text());
  close(c.last("u"), given.last("u"), 1e-12);
  close(c.last("s"), given.last("s"), 1e-12);
  close(c.last("s") / c.last("plain"), 0.9 / std::pow(h, 2.0 / 3.0), 1e-12);
  q.factors = ", flexibility = 1.0";
  CHECK(compute(q.text()).last("u") < 0.7 * c.last("u"));
}

TEST_CASE("check: mass and centre of a half circle") {
  Quarter q;
  std::string text = q.text();
  const auto put = [&](const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
  };
  put("mass_per_length = 0.0", "mass_per_length = 2.0");
  put("B = " + q.at(M_PI / 2.0, 1.3, 2.0, -1.0), "B = " + q.at(M_PI, 1.3, 2.0, -1.0));
  put("elements = 8", "elements = 400");
  put("mass = 0.1", "mass = 0.0");
  const Scene scene = parse_scene(text, "test.toml", {{"run.engine", "exact"}});
  const check::CheckReport report = check::check(scene, build_model(scene));
  REQUIRE(report.mass);
  const double half = M_PI / 800.0;  // of 400 chords
  close(report.mass->total, 2.0 * 800.0 * 1.3 * std::sin(half), 1e-12);
  close(report.mass->x, 2.0, 1e-12);
  close(report.mass->y, -1.0 + 1.3 * std::cos(half) / (400.0 * std::sin(half)), 1e-12);
  close(report.mass->total, 2.0 * M_PI * 1.3, 1e-5);
}

// 24 chords turn by 1e6 rad in the time of the run, with swings that are the rounding of the displacements.
TEST_CASE(
    "a bend at rest: envelopes and stresses are those of its equilibrium, and nobody looks for its "
    "rounding") {
  Quarter quarter;
  quarter.elements = 24;
  quarter.section =
      fmt::format("EA = {}\nEI = {}\nmass_per_length = 1e-4\narea = 0.02\nmodulus = 0.001", EA, EI);
  quarter.more = output("e", "envelope", "nodes = [\"A\", \"B\"]\nquantity = \"stress\"") +
                 output("M", "member_force", "at = [\"A\", \"B\"]\nquantity = \"M\"") +
                 output("V", "member_force", "at = [\"A\", \"B\"]\nquantity = \"V\"\nstation = 0.3");
  std::string text = quarter.text();
  text.replace(text.find("mass = \"lumped\""), 15, "mass = \"consistent\"");
  const Computed c = compute(text, "exact", {{"run.t_end", "10.0"}, {"run.flow", "modal"}});
  CHECK(c.model.omega_max * 10.0 > 1e6);
  for (const char* name : {"e", "M", "V"}) {
    CAPTURE(name);
    const OutputExtremes& e = c.extremes(name);
    const double at_rest = c.result.responses.front().values[c.index(name)];
    const double most = std::abs(e.maximum) > std::abs(e.minimum) ? e.maximum : e.minimum;
    CHECK(std::abs(most) == doctest::Approx(std::abs(at_rest)).epsilon(1e-9));
    CHECK(c.last(name) == doctest::Approx(at_rest).epsilon(1e-9));
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::bends
