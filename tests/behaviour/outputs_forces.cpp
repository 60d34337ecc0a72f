// Member forces, reactions and springs against closed forms, own equilibrium and finite elements of our own.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <tuple>

#include "behaviour/engines.hpp"
#include "behaviour/outputs.hpp"

namespace signorini::tests::outputs {

TEST_SUITE_BEGIN("behaviour/outputs_forces");

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

TEST_CASE("outputs: a foot between two supported nodes gives each its part of N and of T") {
  // Weight and a pull hold a mass on the segment from P to Q, seven tenths of the way from Q.
  for (const double angle : {0.0, 0.4, 2.0}) {
    CAPTURE(angle);
    const double c = std::cos(angle), s = std::sin(angle);
    const auto at = [&](double x, double y) {
      return fmt::format("[{:.17g}, {:.17g}]", c * x - s * y, s * x + c * y);
    };
    std::string text = fmt::format(
        "schema = 1\nunits = {{ force = \"kN\", mass = \"t\", length = \"m\", time = \"s\" }}\ngravity = "
        "{}\n[run]\n"
        "t_end = 0.1\ninitial = \"frictional\"\n[nodes]\nP = {}\nQ = {}\nm = {}\n[[masses]]\nnode = "
        "\"m\"\nmass "
        "= 2.0\n"
        "[[supports]]\nnodes = [\"P\", \"Q\"]\nfix = [\"ux\", \"uy\"]\n[[loads]]\nnode = \"m\"\ndirection = "
        "{}\n"
        "amplitude = 5.0\n[[contacts]]\nname = \"foot\"\nnode = \"m\"\nagainst = [\"P\", \"Q\"]\nnormal = "
        "{}\nlaw = "
        "\"compliant\"\nnormal_stiffness = 3e4\ntangential_stiffness = 2e4\nfriction = 0.6\n",
        at(0.0, -10.0), at(0.3, -0.2), at(2.3, -0.2), at(0.9, -0.2), at(1.0, 0.0), at(0.0, 1.0));
    for (const char* node : {"P", "Q"})
      for (const auto& [across, x, y] : {std::tuple{"along", 1.0, 0.0}, std::tuple{"across", 0.0, 1.0}})
        text += output(fmt::format("{}{}", node, across), "reaction",
                       fmt::format("at = \"{}\"\ndirection = {}", node, at(x, y)));
    const Computed found = compute(text);
    CHECK(std::abs(found.last("Palong") + 0.7 * 5.0) < 1e-10);
    CHECK(std::abs(found.last("Qalong") + 0.3 * 5.0) < 1e-10);
    CHECK(std::abs(found.last("Pacross") - 0.7 * 20.0) < 1e-10);
    CHECK(std::abs(found.last("Qacross") - 0.3 * 20.0) < 1e-10);
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

TEST_SUITE_END();

}  // namespace signorini::tests::outputs
