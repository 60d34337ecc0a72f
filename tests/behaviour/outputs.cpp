// Response quantities against closed forms, own equilibrium, finer grids, and the same scene seen otherwise.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <numbers>

#include "behaviour/engines.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::outputs {
namespace {

struct Computed {
  Model model;
  Result result;

  [[nodiscard]] std::size_t index(const std::string& name) const {
    for (std::size_t i = 0; i < model.outputs.size(); ++i)
      if (model.outputs[i].name == name) return i;
    FAIL("no output " << name);
    return 0;
  }
  /// The last row's value.
  [[nodiscard]] double last(const std::string& name) const {
    return result.responses.back().values[index(name)];
  }
  [[nodiscard]] const OutputExtremes& extremes(const std::string& name) const {
    return result.report.response[index(name)];
  }
};

Computed compute(const std::string& text, const std::string& engine = "exact",
                 const std::vector<Override>& more = {}) {
  std::vector<Override> changes{
      {"run.engine", engine}, {"run.rtol", "1e-10"}, {"run.dt", "1e-4"}, {"run.certify", "false"}};
  changes.insert(changes.end(), more.begin(), more.end());
  const Scene scene = parse_scene(text, "test.toml", changes);
  Computed computed{build_model(scene), {}};
  computed.result = simulate(computed.model, scene.run);
  return computed;
}

std::string output(const std::string& name, const std::string& kind, const std::string& rest) {
  return fmt::format("[[output]]\nname = \"{}\"\nkind = \"{}\"\n{}\n", name, kind, rest);
}

std::string cut(const std::string& name, const std::string& quantity, double station,
                const std::string& at = "[\"A\", \"B\"]") {
  return output(name, "member_force",
                fmt::format("at = {}\nquantity = \"{}\"\nstation = {:.17g}", at, quantity, station));
}

const std::string head = R"(schema = 1
units = { force = "kN", mass = "t", length = "m", time = "s" }
gravity = [0.0, -10.0]
[run]
t_end = 0.1
initial = "static"
output_dt = 0.02
[sections.s]
EA = 2e5
EI = 3e4
mass_per_length = 0.4
)";

/// A beam of length 6 from A to B in 3 elements, as `supports` hold it; its weight is 4 a length.
std::string beam(const std::string& supports, const std::string& rest, const std::string& member = "") {
  return head +
         "[nodes]\nA = [0.0, 0.0]\nB = [6.0, 0.0]\n[[members]]\nnodes = [\"A\", \"B\"]\nsection = \"s\"\n" +
         "elements = 3\n" + member + "\n" + supports + rest;
}
const std::string clamped_at_A = "[[supports]]\nnode = \"A\"\nfix = [\"ux\", \"uy\", \"rz\"]\n";
const std::string simple =
    "[[supports]]\nnode = \"A\"\nfix = [\"ux\", \"uy\"]\n[[supports]]\nnode = \"B\"\nfix = [\"uy\"]\n";

}  // namespace

TEST_SUITE_BEGIN("behaviour/outputs");

TEST_CASE("outputs: N, V and M of a cantilever under its weight and forces at its end") {
  std::string text = beam(clamped_at_A,
                          "[[loads]]\nnode = \"B\"\ndirection = [0.0, -1.0]\namplitude = 7.0\n"
                          "[[loads]]\nnode = \"B\"\ndirection = [1.0, 0.0]\namplitude = 11.0\n"
                          "[[loads]]\nnode = \"B\"\nmoment = 2.5\n");
  const std::vector<double> stations{0.0, 0.1, 1.0 / 3.0, 0.5, 0.77, 1.0};
  for (std::size_t i = 0; i < stations.size(); ++i)
    for (const char* q : {"N", "V", "M"}) {
      text += cut(fmt::format("{}{}", q, i), q, stations[i]);
      text += cut(fmt::format("back{}{}", q, i), q, 1.0 - stations[i], "[\"B\", \"A\"]");
    }
  for (const std::string& engine : locating_engines) {
    CAPTURE(engine);
    const Computed c = compute(text, engine);
    const double eps = 1e-10;
    for (std::size_t i = 0; i < stations.size(); ++i) {
      CAPTURE(i);
      const double rest = 6.0 * (1.0 - stations[i]);
      const double V = 7.0 + 4.0 * rest, M = -7.0 * rest - 2.0 * rest * rest + 2.5;
      const auto is = [&](const char* name, double value, double scale) {
        CHECK(std::abs(c.last(fmt::format("{}{}", name, i)) - value) < eps * scale);
      };
      is("N", 11.0, 11.0);
      is("V", V, 31.0);
      is("M", M, 112.0);
      // From B to A left is right: M has the other sign.
      is("backN", 11.0, 11.0);
      is("backV", V, 31.0);
      is("backM", -M, 112.0);
    }
  }
}

TEST_CASE("outputs: a simply supported beam under a uniform load; lumped masses, a bar, heat") {
  const std::string load = "[[loads]]\nnodes = [\"A\", \"B\"]\ndirection = [0.0, -1.0]\ndistributed = 3.0\n";
  std::string wanted;
  for (const double s : {0.0, 0.2, 0.5, 1.0}) {
    wanted += cut(fmt::format("V{:.0f}", 10 * s), "V", s);
    wanted += cut(fmt::format("M{:.0f}", 10 * s), "M", s);
  }
  const Computed c = compute(beam(simple, load + wanted));
  for (const double s : {0.0, 0.2, 0.5, 1.0}) {
    CAPTURE(s);
    CHECK(std::abs(c.last(fmt::format("V{:.0f}", 10 * s)) - 7.0 * (3.0 - 6.0 * s)) < 1e-10 * 21.0);
    CHECK(std::abs(c.last(fmt::format("M{:.0f}", 10 * s)) - 7.0 * 18.0 * s * (1.0 - s)) < 1e-10 * 31.5);
  }
  SUBCASE("a lumped mass hangs at the nodes: its weight makes steps of V") {
    const Computed lumped = compute(beam(simple, wanted, "mass = \"lumped\""));
    CHECK(lumped.last("V2") == doctest::Approx(8.0).epsilon(1e-10));
    CHECK(lumped.last("M5") == doctest::Approx(16.0).epsilon(1e-10));
  }
  SUBCASE("heat between two walls") {
    const std::string walls = clamped_at_A + "[[supports]]\nnode = \"B\"\nfix = [\"ux\", \"uy\", \"rz\"]\n";
    const Computed hot = compute(beam(walls, cut("N", "N", 0.4) + cut("M", "M", 0.5),
                                      "thermal_expansion = 1e-5\ntemperature = 30.0\ninitial_strain = 1e-4"));
    CHECK(hot.last("N") == doctest::Approx(-2e5 * 4e-4).epsilon(1e-10));
    CHECK(hot.last("M") == doctest::Approx(4.0 * 36.0 / 24.0).epsilon(1e-10));
  }
  SUBCASE("a bar carries its weight to its ends as a beam on two supports") {
    std::string bar = head +
                      "[nodes]\nA = [0.0, 0.0]\nB = [6.0, 0.0]\n[[members]]\nnodes = [\"A\", \"B\"]\n" +
                      "section = \"s\"\ntype = \"bar\"\n" + simple + wanted;
    const Computed truss = compute(bar);
    CHECK(truss.last("V0") == doctest::Approx(12.0).epsilon(1e-10));
    CHECK(truss.last("M5") == doctest::Approx(18.0).epsilon(1e-10));
  }
}

TEST_CASE("outputs: V jumps at a load by the load, M goes through") {
  const std::string text =
      head +
      "[nodes]\nA = [0.0, 0.0]\nB = [2.0, 0.0]\nC = [6.0, 0.0]\n[[members]]\nnodes = [\"A\", \"B\", "
      "\"C\"]\n" +
      "section = \"s\"\nelements = [2, 3]\n[[supports]]\nnode = \"A\"\nfix = [\"ux\", \"uy\"]\n" +
      "[[supports]]\nnode = \"C\"\nfix = [\"uy\"]\n" +
      "[[loads]]\nnode = \"B\"\ndirection = [0.0, -1.0]\namplitude = 9.0\n" +
      "history = { type = \"half_sine\", start = 0.01, duration = 0.05 }\n" + cut("V1", "V", 1.0) +
      cut("M1", "M", 1.0) + cut("V2", "V", 0.0, "[\"B\", \"C\"]") + cut("M2", "M", 0.0, "[\"B\", \"C\"]") +
      output("jump", "combination", "terms = { V2 = 1.0, V1 = -1.0 }") +
      output("kink", "combination", "terms = { M2 = 1.0, M1 = -1.0 }");
  const Computed c = compute(text, "exact", {{"run.output_dt", "0.005"}});
  REQUIRE(c.result.responses.size() >= 21);
  for (const auto& row : c.result.responses) {
    CAPTURE(row.t);
    const double load =
        row.t > 0.01 && row.t < 0.06 ? 9.0 * std::sin(std::numbers::pi * (row.t - 0.01) / 0.05) : 0.0;
    CHECK(std::abs(row.values[c.index("jump")] + load) < 1e-10 * 9.0);
    CHECK(std::abs(row.values[c.index("kink")]) < 1e-10 * 40.0);
  }
  CHECK(c.extremes("jump").minimum == doctest::Approx(-9.0).epsilon(1e-10));
  CHECK(c.extremes("jump").t_minimum == doctest::Approx(0.035).epsilon(1e-6));
  CHECK(c.extremes("M1").maximum > 16.0);  // it moved
}

/// A frame that a support moves, on the ground that shakes, with springs, a mass, a contact and a damper.
std::string frame(const std::string& rest) {
  return R"(schema = 1
units = { force = "kN", mass = "t", length = "m", time = "s" }
gravity = [1.0, -10.0]
[run]
t_end = 0.4
output_dt = 0.01
initial = { B = { vx = 0.3, vy = -0.2 } }
[damping]
alpha = 0.4
beta = 1e-4
[sections.s]
EA = 2e4
EI = 3e3
mass_per_length = 0.4
[nodes]
A = [0.0, 0.0]
B = [1.0, 3.0]
C = [4.0, 3.0]
D = [4.0, 0.0]
[[members]]
nodes = ["A", "B", "C"]
section = "s"
elements = [3, 2]
thermal_expansion = 1e-5
temperature = { type = "table", times = [0.0, 0.2, 1.0], values = [0.0, 40.0, 40.0], interpolation = "steffen" }
[[members]]
nodes = ["C", "D"]
section = "s"
elements = 2
mass = "lumped"
[[masses]]
node = "B"
mass = 1.5
inertia = 0.2
[[masses]]
node = "D"
mass = 0.7
[[springs]]
node = "C"
direction = [3.0, -4.0]
stiffness = 200.0
damping = 3.0
[[springs]]
node = "B"
against = "D"
direction = [1.0, 1.0]
stiffness = 100.0
damping = 1.0
[[supports]]
node = "A"
fix = ["ux", "uy"]
[[supports]]
node = "D"
fix = ["uy"]
[[supports]]
node = "D"
fix = ["ux"]
motion = { type = "table", times = [0.0, 0.1, 0.3, 1.0], values = [0.0, 0.01, -0.005, 0.0], interpolation = "steffen" }
[[contacts]]
name = "floor"
node = "B"
law = "compliant"
normal = [0.6, 0.8]
gap = 0.001
normal_stiffness = 1e4
tangential_stiffness = 5e3
friction = 0.4
[[loads]]
node = "D"
direction = [1.0, 0.0]
amplitude = 5.0
history = { type = "half_sine", start = 0.0, duration = 0.1 }
[[loads]]
nodes = ["A", "B"]
direction = [1.0, 0.0]
axes = "member"
distributed = 2.0
[[base_motion]]
direction = [1.0, 0.0]
acceleration = { type = "harmonic", amplitude = 3.0, offset = 0.0, omega = 20.0, start = 0.0 }
)" + rest;
}

const std::string reactions = output("Ax", "reaction", "at = \"A\"\ndirection = [1.0, 0.0]") +
                              output("Ay", "reaction", "at = \"A\"\ndirection = [0.0, 1.0]") +
                              output("Dx", "reaction", "at = \"D\"\ndirection = [1.0, 0.0]") +
                              output("Dy", "reaction", "at = \"D\"\ndirection = [0.0, 1.0]");

TEST_CASE("outputs: reactions are the sum of loads and inertia, and follow from the members at the support") {
  const std::string text = frame(reactions + cut("N", "N", 0.0) + cut("V", "V", 0.0) +
                                 output("aB", "acceleration", "at = \"B\"\ndirection = [0.0, 1.0]"));
  for (const std::string& engine : locating_engines) {
    CAPTURE(engine);
    const Computed c = compute(text, engine, {{"run.dt", "1e-3"}});
    REQUIRE(c.result.report.audit.reactions);
    const double scale = c.result.report.audit.force_scale;
    CHECK(c.result.report.audit.reactions->value < (engine == "ida" ? 1e-7 : 1e-10) * scale);
    // A is the end of one member and nothing else: what the support gives is what the member takes.
    const double cosine = 1.0 / std::sqrt(10.0), sine = 3.0 / std::sqrt(10.0);
    double greatest = 0.0;
    for (const auto& row : c.result.responses) {
      const double N = row.values[c.index("N")], V = row.values[c.index("V")];
      CHECK(std::abs(row.values[c.index("Ax")] - (-N * cosine - V * sine)) < 1e-10 * scale);
      CHECK(std::abs(row.values[c.index("Ay")] - (-N * sine + V * cosine)) < 1e-10 * scale);
      greatest = std::max(greatest, std::abs(N));
    }
    CHECK(greatest > 1.0);
    CHECK(c.result.events.size() >= 2);
  }
}

TEST_CASE("outputs: a mass on a spring on the ground that shakes") {
  const std::string text = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
gravity = [0.0, 0.0]
[run]
t_end = 3.0
output_dt = 0.5
[nodes]
A = [0.0, 0.0]
B = [1.0, 0.0]
[[masses]]
node = "A"
mass = 2.0
[[masses]]
node = "B"
mass = 1.0
[[supports]]
nodes = ["A", "B"]
fix = ["uy"]
[[springs]]
node = "A"
direction = [1.0, 0.0]
stiffness = 50.0
damping = 0.5
[[springs]]
node = "B"
against = "A"
direction = [1.0, 0.0]
stiffness = 30.0
damping = 0.2
[base_motion]
direction = [1.0, 0.0]
acceleration = { type = "harmonic", amplitude = 2.0, omega = 7.0 }
)" + output("a", "acceleration", "at = \"A\"\ndirection = [1.0, 0.0]") +
                           output("b", "acceleration", "at = \"B\"\ndirection = [1.0, 0.0]") +
                           output("F", "spring", "spring = 1") + output("G", "spring", "spring = 2") +
                           output("u", "displacement", "at = \"A\"\ndirection = [1.0, 0.0]") +
                           output("v", "velocity", "at = \"A\"\ndirection = [-2.0, 0.0]") +
                           output("d", "relative", "at = [\"B\", \"A\"]\ndirection = [1.0, 0.0]") +
                           output("mass", "combination", "terms = { F = -1.0, G = 1.0 }");
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Computed c = compute(text, engine);
    const double eps = engine == "ida" ? 1e-7 : 1e-12;
    double greatest = 0.0;
    for (std::size_t i = 0; i < c.result.responses.size(); ++i) {
      const auto& values = c.result.responses[i].values;
      const auto& row = c.result.rows[i];
      REQUIRE(row.t == c.result.responses[i].t);
      const auto is = [&](const char* name, double expected) {
        CAPTURE(name);
        CHECK(std::abs(values[c.index(name)] - expected) < eps * 4.0);
      };
      is("u", row.u[0]);
      is("v", -row.v[0]);
      is("d", row.u[1] - row.u[0]);
      is("F", 50.0 * row.u[0] + 0.5 * row.v[0]);
      is("G", 30.0 * (row.u[1] - row.u[0]) + 0.2 * (row.v[1] - row.v[0]));
      is("a", values[c.index("mass")] / 2.0);  // absolute: nothing but springs acts
      is("b", -values[c.index("G")]);
      greatest = std::max(greatest, std::abs(values[c.index("a")]));
    }
    CHECK(greatest > 0.5);
  }
}

/// A beam element of the textbook: u, a and g in local axes, ux uy rz at both ends.
struct Element {
  double EA, EI, rho, L;
  using Ends = std::array<double, 6>;

  /// What the nodes do to its ends: K u + M (a - g).
  [[nodiscard]] Ends forces(const Ends& u, const Ends& a, const std::array<double, 2>& g) const {
    const Ends q{a[0] - g[0], a[1] - g[1], a[2], a[3] - g[0], a[4] - g[1], a[5]};
    const double k = EA / L, b = EI / (L * L * L), m = rho * L / 420.0;
    const double lateral[4][4] = {{12, 6 * L, -12, 6 * L},
                                  {6 * L, 4 * L * L, -6 * L, 2 * L * L},
                                  {-12, -6 * L, 12, -6 * L},
                                  {6 * L, 2 * L * L, -6 * L, 4 * L * L}};
    const double mass[4][4] = {{156, 22 * L, 54, -13 * L},
                               {22 * L, 4 * L * L, 13 * L, -3 * L * L},
                               {54, 13 * L, 156, -22 * L},
                               {-13 * L, -3 * L * L, -22 * L, 4 * L * L}};
    const std::size_t at[4] = {1, 2, 4, 5};
    Ends f{k * (u[0] - u[3]) + m * (140 * q[0] + 70 * q[3]), 0, 0,
           k * (u[3] - u[0]) + m * (70 * q[0] + 140 * q[3]), 0, 0};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        f[at[i]] += b * lateral[i][j] * u[at[j]] + m * mass[i][j] * q[at[j]];
    return f;
  }
  /// The load along it: what its mass does not follow.
  [[nodiscard]] std::array<double, 2> load(const Ends& a, const std::array<double, 2>& g, double x) const {
    const double s = x / L;
    const double across = (1 - 3 * s * s + 2 * s * s * s) * a[1] + L * (s - 2 * s * s + s * s * s) * a[2] +
                          (3 * s * s - 2 * s * s * s) * a[4] + L * (s * s * s - s * s) * a[5];
    return {-rho * ((1 - s) * a[0] + s * a[3] - g[0]), -rho * (across - g[1])};
  }
  /// N, V, M at x; integrals of the load, of degree four at most, by Boole's rule.
  [[nodiscard]] std::array<double, 3> cut(const Ends& u, const Ends& a, const std::array<double, 2>& g,
                                          double x) const {
    const Ends f = forces(u, a, g);
    const double weights[] = {7.0 / 90, 32.0 / 90, 12.0 / 90, 32.0 / 90, 7.0 / 90};
    double N = -f[0], V = f[1], M = -f[2] + f[1] * x;
    for (int i = 0; i < 5; ++i) {
      const double y = x * i / 4.0;
      const auto p = load(a, g, y);
      N -= weights[i] * x * p[0];
      V += weights[i] * x * p[1];
      M += weights[i] * x * (x - y) * p[1];
    }
    return {N, V, M};
  }
};

TEST_CASE("outputs: member forces are those of finite elements of our own, at rest and in motion") {
  const std::array<std::array<double, 2>, 3> places{{{0.0, 0.0}, {1.5, 4.0}, {6.0, 3.0}}};
  std::string text = R"(schema = 1
units = { force = "kN", mass = "t", length = "m", time = "s" }
gravity = [1.5, -9.81]
[run]
t_end = 0.3
output_dt = 0.01
initial = "static"
[sections.s]
EA = 3e4
EI = 5e3
mass_per_length = 0.7
[nodes]
n0 = [0.0, 0.0]
n1 = [1.5, 4.0]
n2 = [6.0, 3.0]
[[members]]
nodes = ["n0", "n1"]
section = "s"
[[members]]
nodes = ["n1", "n2"]
section = "s"
[[supports]]
node = "n0"
fix = ["ux", "uy", "rz"]
[[contacts]]
name = "foot"
node = "n2"
law = "compliant"
normal = [0.0, 1.0]
normal_stiffness = 1e4
tangential_stiffness = 1e4
friction = 0.3
[[loads]]
node = "n1"
direction = [1.0, 0.5]
amplitude = 40.0
history = { type = "half_sine", start = 0.02, duration = 0.1 }
)";
  const std::vector<double> stations{0.0, 0.37, 1.0};
  for (int n = 0; n < 3; ++n)
    for (const char* kind : {"displacement", "acceleration"})
      for (const char* what : {"direction = [1.0, 0.0]", "direction = [0.0, 1.0]", "rotation = true"})
        text += output(fmt::format("{}{}{}", kind[0], n,
                                   what[13] == '1'  ? 'x'
                                   : what[0] == 'r' ? 'r'
                                                    : 'y'),
                       kind, fmt::format("at = \"n{}\"\n{}", n, what));
  for (int e = 0; e < 2; ++e)
    for (std::size_t i = 0; i < stations.size(); ++i)
      for (const char* q : {"N", "V", "M"})
        text +=
            cut(fmt::format("{}{}{}", q, e, i), q, stations[i], fmt::format("[\"n{}\", \"n{}\"]", e, e + 1));
  for (const std::string& engine : locating_engines) {
    CAPTURE(engine);
    const Computed c = compute(text, engine);
    CHECK(c.result.events.size() >= 2);
    double greatest = 0.0, fastest = 0.0;
    for (const auto& row : c.result.responses) {
      CAPTURE(row.t);
      const auto value = [&](char kind, int n, char axis) {
        return row.values[c.index(fmt::format("{}{}{}", kind, n, axis))];
      };
      for (int e = 0; e < 2; ++e) {
        const auto &from = places[static_cast<std::size_t>(e)], &to = places[static_cast<std::size_t>(e) + 1];
        const double L = std::hypot(to[0] - from[0], to[1] - from[1]);
        const double cosine = (to[0] - from[0]) / L, sine = (to[1] - from[1]) / L;
        const auto local = [&](char kind) {
          Element::Ends ends{};
          for (std::size_t i = 0; i < 2; ++i) {
            const int n = e + static_cast<int>(i);
            const double x = value(kind, n, 'x'), y = value(kind, n, 'y');
            ends[3 * i] = cosine * x + sine * y;
            ends[3 * i + 1] = -sine * x + cosine * y;
            ends[3 * i + 2] = value(kind, n, 'r');
          }
          return ends;
        };
        const Element element{3e4, 5e3, 0.7, L};
        const std::array<double, 2> g{cosine * 1.5 - sine * 9.81, -sine * 1.5 - cosine * 9.81};
        fastest = std::max(fastest, std::abs(local('a')[4]));
        for (std::size_t i = 0; i < stations.size(); ++i) {
          const auto expected = element.cut(local('d'), local('a'), g, stations[i] * L);
          for (std::size_t q = 0; q < 3; ++q) {
            const double found = row.values[c.index(fmt::format("{}{}{}", "NVM"[q], e, i))];
            CHECK(std::abs(found - expected[q]) < 1e-10 * 100.0);
            greatest = std::max(greatest, std::abs(found));
          }
        }
      }
    }
    CHECK(greatest > 50.0);
    CHECK(fastest > 1.0);
  }
}

TEST_CASE("outputs: extremes between rows are those of a grid a thousand times finer") {
  const std::string wanted = reactions + cut("M", "M", 0.63) + cut("V", "V", 1.0) +
                             output("aC", "acceleration", "at = \"C\"\ndirection = [1.0, 1.0]") +
                             output("uB", "displacement", "at = \"B\"\ndirection = [1.0, 0.0]") +
                             output("turn", "displacement", "at = \"B\"\nrotation = true") +
                             output("T", "contact", "at = \"floor\"\nquantity = \"T\"") +
                             output("N", "contact", "at = \"floor\"\nquantity = \"N\"") +
                             output("gap", "contact", "at = \"floor\"\nquantity = \"gap\"") +
                             output("slip", "contact", "at = \"floor\"\nquantity = \"slip\"");
  // Without histories, so that modes can follow it.
  const std::string tapping =
      beam(clamped_at_A, R"([[contacts]]
name = "tip"
node = "B"
law = "compliant"
normal = [0.0, 1.0]
gap = 0.01
normal_stiffness = 1e4
[[loads]]
node = "B"
direction = [0.0, -1.0]
amplitude = 20.0
[damping]
alpha = 0.5
)" + cut("M", "M", 0.0) + cut("V", "V", 1.0 / 3.0) +
                             output("aB", "acceleration", "at = \"B\"\ndirection = [0.0, 1.0]") +
                             output("N", "contact", "at = \"tip\"\nquantity = \"N\""));
  struct Way {
    const char *engine, *flow;
    const std::string& text;
    double eps;
  };
  const std::string shaken = frame(wanted);
  for (const Way& way : {Way{"exact", "taylor", shaken, 1e-9}, Way{"exact", "modal", tapping, 1e-9},
                         Way{"ida", "auto", shaken, 1e-6}}) {
    CAPTURE(std::string(way.engine));
    CAPTURE(std::string(way.flow));
    std::vector<Override> changes{{"run.flow", way.flow}};
    if (std::string(way.flow) == "modal") changes.push_back({"run.initial", "{}"});
    changes.push_back({"run.output_dt", "0.1"});
    const Computed coarse = compute(way.text, way.engine, changes);
    changes.back().value = "1e-4";
    const Computed fine = compute(way.text, way.engine, changes);
    for (std::size_t i = 0; i < coarse.model.outputs.size(); ++i) {
      CAPTURE(coarse.model.outputs[i].name);
      double greatest = -1e300, least = 1e300;
      for (const auto& row : fine.result.responses) {
        greatest = std::max(greatest, row.values[i]);
        least = std::min(least, row.values[i]);
      }
      const OutputExtremes& e = coarse.result.report.response[i];
      const double size = std::max(std::abs(greatest), std::abs(least));
      // A grid sees less than the extreme, by its spacing squared at most.
      CHECK(e.maximum >= greatest - way.eps * size);
      CHECK(e.minimum <= least + way.eps * size);
      CHECK(e.maximum <= greatest + 1e-3 * size);
      CHECK(e.minimum >= least - 1e-3 * size);
      CHECK(e.t_maximum >= 0.0);
      CHECK(e.t_minimum <= 0.4);
      CHECK(e.maximum > e.minimum);
    }
  }
}

TEST_CASE("outputs: the peak of a free oscillation and its time in closed form") {
  const std::string text = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 5.0
output_dt = 5.0
initial = { u = [0.3], v = [2.0] }
[matrices]
mass = [[2.0]]
stiffness = [[50.0]]
damping = [[0.8]]
)" + output("u", "displacement", "direction = { d0 = 1.0 }") +
                           output("a", "acceleration", "direction = { d0 = -2.0 }");
  // u = exp(-z t) (0.3 cos w t + b sin w t)
  const double z = 0.2, w = std::sqrt(25.0 - z * z), b = (2.0 + z * 0.3) / w;
  // u' = 0: tan w t = (b w - 0.3 z) / (0.3 w + b z)
  const double t = std::atan2(b * w - 0.3 * z, 0.3 * w + b * z) / w;
  const double peak = std::exp(-z * t) * (0.3 * std::cos(w * t) + b * std::sin(w * t));
  for (const char* flow : {"\"taylor\"", "\"modal\""}) {
    CAPTURE(flow);
    const Computed c = compute(text, "exact", {{"run.flow", flow}});
    CHECK(std::abs(c.extremes("u").maximum - peak) < 1e-14);
    CHECK(std::abs(c.extremes("u").t_maximum - t) < 1e-11);
    CHECK(c.result.responses.size() == 2);  // none of it in a row
    CHECK(c.extremes("a").t_maximum > 0.0);
  }
  const Computed ida = compute(text, "ida", {{"run.rtol", "1e-9"}});
  CHECK(std::abs(ida.extremes("u").maximum - peak) < 1e-7);
  CHECK(std::abs(ida.extremes("u").t_maximum - t) < 1e-6);
  const Computed steps = compute(text, "newmark", {{"run.dt", "1e-3"}});
  CHECK(std::abs(steps.extremes("u").maximum - peak) < 1e-5);
  CHECK(std::abs(steps.extremes("u").t_maximum - t) < 1e-5);
}

TEST_CASE("outputs: extremes are those of the motion, however rows are spaced") {
  // u = exp(-z t) (cos w t + z/w sin w t), u' = -exp(-z t)/w sin w t: extremes of u' where tan w t = w/z.
  const double z = 0.01, w = std::sqrt(1.0 - z * z), t = std::atan2(w, z) / w;
  const double least = -std::exp(-z * t) / w * std::sin(w * t);
  const double lowest = -std::exp(-z * std::numbers::pi / w);
  const std::string text = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 10.0
initial = { u = [1.0], v = [0.0] }
[matrices]
mass = [[1.0]]
stiffness = [[1.0]]
damping = [[0.02]]
)" + output("u", "displacement", "direction = { d0 = 1.0 }") +
                           output("v", "velocity", "direction = { d0 = 1.0 }");
  for (const char* dt : {"10", "0.1", "0.01", "0.0007"}) {
    CAPTURE(std::string(dt));
    for (const char* flow : {"taylor", "modal"}) {
      CAPTURE(std::string(flow));
      const Computed c = compute(text, "exact", {{"run.flow", flow}, {"run.output_dt", dt}});
      CHECK(std::abs(c.extremes("v").minimum - least) < 1e-14);
      CHECK(std::abs(c.extremes("v").t_minimum - t) < 1e-7);
      CHECK(std::abs(c.extremes("u").minimum - lowest) < 1e-14);
      CHECK(std::abs(c.extremes("u").t_minimum - std::numbers::pi / w) < 1e-7);
    }
    const Computed ida = compute(text, "ida", {{"run.output_dt", dt}});
    CHECK(std::abs(ida.extremes("v").minimum - least) < 1e-8);
    CHECK(std::abs(ida.extremes("v").t_minimum - t) < 1e-4);
  }
}

TEST_CASE("outputs: of many equal peaks the greatest is found, of beats, in one step and in many") {
  // Expected: the closed form on a grid of 1e-4, which sees peaks to some 1e-8.
  for (const double k : {8.052433795271492, 3.3, 27.1}) {
    CAPTURE(k);
    const double w = std::sqrt(k), p = 0.6317071082430643, q = -0.9945229996597038 / w;
    const std::string text = fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
[run]
t_end = 60.0
initial = {{ u = [1.0, {:.17g}], v = [0.0, {:.17g}] }}
[matrices]
mass = [[1.0, 0.0], [0.0, 1.0]]
stiffness = [[1.0, 0.0], [0.0, {:.17g}]]
)",
                                         p, q * w, k) +
                             output("rel", "displacement", "direction = { d0 = 1.0, d1 = -1.0 }");
    const auto at = [&](double t) { return std::cos(t) - p * std::cos(w * t) - q * std::sin(w * t); };
    double greatest = -10.0, least = 10.0;
    for (double t = 0.0; t <= 60.0; t += 1e-4) {
      greatest = std::max(greatest, at(t));
      least = std::min(least, at(t));
    }
    for (const char* dt : {"60", "0.05"}) {
      CAPTURE(std::string(dt));
      const Computed c = compute(text, "exact", {{"run.output_dt", dt}});
      CHECK(c.extremes("rel").maximum == doctest::Approx(greatest).epsilon(1e-7));
      CHECK(c.extremes("rel").maximum >= greatest - 1e-13);
      CHECK(c.extremes("rel").minimum == doctest::Approx(least).epsilon(1e-7));
      CHECK(c.extremes("rel").minimum <= least + 1e-13);
      CHECK(std::abs(at(c.extremes("rel").t_maximum) - c.extremes("rel").maximum) < 1e-12);
    }
  }
}

TEST_CASE("outputs: extremes that a load makes which is faster than every mode") {
  const std::string text = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 10.0
output_dt = 10.0
[nodes]
A = [0.0, 0.0]
B = [1.0, 0.0]
[[masses]]
node = "A"
mass = 1.0
[[masses]]
node = "B"
mass = 1.0
[[supports]]
node = "A"
fix = ["ux", "uy"]
[[supports]]
node = "B"
fix = ["uy"]
[[springs]]
node = "B"
direction = [1.0, 0.0]
stiffness = 1.0
[[loads]]
node = "A"
direction = [0.0, 1.0]
amplitude = 1.0
history = { type = "harmonic", omega = 100.0 }
[[loads]]
node = "A"
direction = [0.0, 1.0]
amplitude = 1.0
history = { type = "harmonic", omega = 101.3, phase = 1.0 }
[[loads]]
node = "B"
direction = [1.0, 0.0]
amplitude = 1.0
history = { type = "harmonic", omega = 100.0 }
[[loads]]
node = "B"
direction = [1.0, 0.0]
amplitude = 1.0
history = { type = "harmonic", omega = 101.3, phase = 1.0 }
)" + output("R", "reaction", "at = \"A\"\ndirection = [0.0, 1.0]") +
                           output("a", "acceleration", "at = \"B\"\ndirection = [1.0, 0.0]");
  // u'' + u = sin(w t + p) from rest: c (sin(w t + p) - sin p cos t - w cos p sin t), c = 1 / (1 - w^2)
  const auto at = [](double t, double w, double p) {
    return (std::sin(p) * std::cos(t) + w * std::cos(p) * std::sin(t) - w * w * std::sin(w * t + p)) /
           (1.0 - w * w);
  };
  double greatest = -10.0, fastest = -10.0;
  for (double t = 0.0; t <= 10.0; t += 1e-5) {
    greatest = std::max(greatest, -std::sin(100.0 * t) - std::sin(101.3 * t + 1.0));
    fastest = std::max(fastest, at(t, 100.0, 0.0) + at(t, 101.3, 1.0));
  }
  for (const std::string& engine : locating_engines) {
    CAPTURE(engine);
    const Computed c = compute(text, engine);
    CHECK(std::abs(c.extremes("R").maximum - greatest) < 1e-6);  // the grid's own spacing squared
    // newmark's stand at the ends of its steps: w^2 dt^2 / 8 of each load may be missed.
    CHECK(std::abs(c.extremes("a").maximum - fastest) < (engine == "newmark" ? 3e-5 : 1e-6));
  }
}

TEST_CASE(
    "outputs: with newmark, too, a free end has no moment, and its extremes are those of rows at all steps") {
  const std::string text = beam(clamped_at_A,
                                "[[loads]]\nnode = \"B\"\ndirection = [0.0, -1.0]\namplitude = 7.0\n"
                                "history = { type = \"half_sine\", start = 0.0, duration = 0.03 }\n" +
                                    cut("end", "M", 1.0) + cut("M", "M", 0.4) +
                                    output("u", "displacement", "at = \"B\"\ndirection = [0.0, 1.0]"));
  const Computed c = compute(text, "newmark", {{"run.dt", "1e-4"}});
  const Computed all = compute(text, "newmark", {{"run.dt", "1e-4"}, {"run.output_dt", "1e-4"}});
  CHECK(c.extremes("M").minimum < -40.0);  // some of it
  CHECK(std::abs(c.extremes("end").maximum) < 1e-9);
  CHECK(std::abs(c.extremes("end").minimum) < 1e-9);
  double least = 0.0;
  for (const auto& row : all.result.responses) least = std::min(least, row.values[all.index("M")]);
  CHECK(c.extremes("M").minimum == doctest::Approx(least).epsilon(1e-10));
}

TEST_CASE("outputs: a scene turned, or in other units, has the same member forces") {
  const std::string wanted = cut("N", "N", 0.4) + cut("V", "V", 0.4) + cut("M", "M", 0.4);
  const auto scene = [&](const std::string& units, double L, double F, double c, double s) {
    const double cosine = c, sine = s;
    return fmt::format(R"(schema = 1
units = {}
gravity = [{:.17g}, {:.17g}]
[run]
t_end = 0.2
output_dt = 0.01
[sections.s]
EA = {:.17g}
EI = {:.17g}
mass_per_length = {:.17g}
[nodes]
A = [0.0, 0.0]
B = [{:.17g}, {:.17g}]
[[members]]
nodes = ["A", "B"]
section = "s"
elements = 3
[[supports]]
node = "A"
fix = ["ux", "uy", "rz"]
[[loads]]
node = "B"
direction = [{:.17g}, {:.17g}]
amplitude = {:.17g}
)",
                       units, 10.0 * L * sine, -10.0 * L * cosine, 2e4 * F, 3e3 * F * L * L,
                       0.4 * F / (L * L), 4.0 * L * cosine, 4.0 * L * sine, 0.6 * cosine - 0.8 * sine,
                       0.6 * sine + 0.8 * cosine, 5.0 * F) +
           wanted;
  };
  const std::string metres = "{ force = \"kN\", mass = \"t\", length = \"m\", time = \"s\" }";
  const Computed level = compute(scene(metres, 1.0, 1.0, 1.0, 0.0));
  const Computed turned = compute(scene(metres, 1.0, 1.0, 0.28, 0.96));
  const Computed fine =
      compute(scene("{ force = \"N\", mass = \"t\", length = \"mm\", time = \"s\" }", 1e3, 1e3, 1.0, 0.0));
  REQUIRE(level.result.responses.size() == turned.result.responses.size());
  REQUIRE(level.result.responses.size() == fine.result.responses.size());
  double greatest = 0.0;
  for (std::size_t r = 0; r < level.result.responses.size(); ++r)
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = level.result.responses[r].values[i];
      const double factor = i == 2 ? 1e6 : 1e3;
      greatest = std::max(greatest, std::abs(x));
      CHECK(std::abs(turned.result.responses[r].values[i] - x) < 1e-9 * 20.0);
      CHECK(std::abs(fine.result.responses[r].values[i] / factor - x) < 1e-9 * 20.0);
    }
  CHECK(greatest > 5.0);
}

TEST_CASE("outputs: a reduced model and one with undamped massless parts give what the full one gives") {
  const std::string wanted = cut("M", "M", 0.5) +
                             output("u", "displacement", "at = \"B\"\ndirection = [0.0, 1.0]") +
                             output("loss", "contact", "at = \"tip\"\nquantity = \"loss\"");
  const std::string contact = R"([[contacts]]
name = "tip"
node = "B"
law = "compliant"
normal = [0.0, 1.0]
gap = 0.002
normal_stiffness = 1e4
tangential_stiffness = 1e4
friction = 0.3
[[loads]]
node = "B"
direction = [3.0, -4.0]
amplitude = 20.0
history = { type = "half_sine", start = 0.0, duration = 0.08 }
)";
  const Computed full = compute(beam(clamped_at_A, contact + wanted));
  const Computed reduced =
      compute(beam(clamped_at_A, contact + "[reduction]\ncutoff_omega = 1e5\n" + wanted));
  for (const char* name : {"M", "u", "loss"}) {
    CAPTURE(name);
    CHECK(reduced.extremes(name).maximum == doctest::Approx(full.extremes(name).maximum).epsilon(1e-8));
    CHECK(reduced.extremes(name).minimum == doctest::Approx(full.extremes(name).minimum).epsilon(1e-8));
  }
  CHECK(full.last("loss") == doctest::Approx(full.result.report.audit.friction_work[0]).epsilon(1e-12));
  CHECK(full.last("loss") > 0.0);
}

TEST_CASE("outputs: both sides of an instant stand in rows, and nothing twice") {
  const std::string text = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 2.0
output_dt = 1.0
initial = { u = [0.0], v = [0.0] }
[matrices]
mass = [[1.0]]
stiffness = [[4.0]]
[[loads]]
direction = { d0 = 1.0 }
amplitude = 3.0
history = { type = "step", start = 0.5 }
)" + output("a", "acceleration", "direction = { d0 = 1.0 }");
  for (const std::string& engine : locating_engines) {
    CAPTURE(engine);
    const Computed c = compute(text, engine);
    const auto& rows = c.result.responses;
    REQUIRE(rows.size() == 5);
    CHECK(rows[1].t == 0.5);
    CHECK(rows[2].t == 0.5);
    CHECK(std::abs(rows[1].values[0]) < 1e-6);
    CHECK(rows[2].values[0] == doctest::Approx(3.0));
    CHECK(c.extremes("a").maximum == doctest::Approx(3.0));
    CHECK(c.extremes("a").t_maximum == 0.5);
    CHECK(c.extremes("a").last == rows.back().values[0]);
  }
}

TEST_CASE("outputs: what is wrong is said with its place") {
  const auto refusal = [](const std::string& what) -> std::string {
    const std::string text =
        frame("") + output("first", "velocity", "at = \"B\"\ndirection = [1.0, 0.0]") + what;
    try {
      (void)build_model(parse_scene(text, "test.toml", {}));
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  };
  const auto has = [](const std::string& text, const std::string& part) {
    CAPTURE(text);
    CHECK(text.find(part) != std::string::npos);
  };
  CHECK(refusal("").empty());
  has(refusal(output("first", "velocity", "at = \"B\"\ndirection = [1.0, 0.0]")), "found \"first\" twice");
  has(refusal(output("t", "velocity", "at = \"B\"\ndirection = [1.0, 0.0]")), "is the time");
  has(refusal(output("x", "velocity", "direction = [1.0, 0.0]")),
      "output.x.at: missing, expected the name of a node");
  has(refusal(output("x", "velocity", "at = \"Q\"\ndirection = [1.0, 0.0]")), "unknown node \"Q\"");
  has(refusal(output("x", "velocity", "at = \"B\"")), "or rotation = true");
  has(refusal(output("x", "velocity", "at = \"B\"\nrotation = true\ndirection = [1.0, 0.0]")),
      "beside rotation");
  has(refusal(output("x", "member_force", "at = [\"A\", \"C\"]\nquantity = \"M\"")),
      "no piece of a member joins");
  has(refusal(output("x", "member_force", "at = [\"A\", \"A\"]\nquantity = \"M\"")), "found \"A\" twice");
  has(refusal(output("x", "member_force", "at = [\"A\", \"B\"]")), "expected one of \"N\", \"V\", \"M\"");
  has(refusal(output("x", "member_force", "at = [\"A\", \"B\"]\nquantity = \"gap\"")), "found");
  has(refusal(output("x", "member_force", "at = [\"A\", \"B\"]\nquantity = \"M\"\nstation = 1.5")),
      "from 0 to 1");
  has(refusal(output("x", "reaction", "at = \"B\"\ndirection = [1.0, 0.0]")),
      "no support holds node 'B' that way");
  has(refusal(output("x", "reaction", "at = \"A\"\nrotation = true")), "no support holds node 'A' that way");
  has(refusal(output("x", "spring", "spring = 3")), "from 1 to 2");
  has(refusal(output("x", "contact", "at = \"flor\"\nquantity = \"N\"")), "did you mean \"floor\"");
  has(refusal(output("x", "contact", "at = \"floor\"\nquantity = \"V\"")), "expected one of \"N\", \"T\"");
  has(refusal(output("x", "combination", "terms = { second = 1.0 }")), "unknown output \"second\"");
  has(refusal(output("l", "contact", "at = \"floor\"\nquantity = \"loss\"") +
              output("x", "combination", "terms = { l = 1.0 }")),
      "is a loss");
  has(refusal(output("g", "contact", "at = \"floor\"\nquantity = \"gap\"") +
              output("x", "combination", "terms = { first = 1.0, g = 1.0 }")),
      "different units");
  has(refusal(output("x", "velocity", "at = \"B\"\ndirection = [1.0, 0.0]\nstation = 0.5")),
      "has no meaning for a velocity");
  const Scene scene = parse_scene(frame(reactions + cut("M", "M", 0.3)), "test.toml", {});
  CHECK(parse_scene(scene.resolved, "test.toml", {}).resolved == scene.resolved);
  CHECK(parse_scene(scene.resolved, "test.toml", {}).outputs.size() == 5);
}

TEST_SUITE_END();

}  // namespace signorini::tests::outputs
