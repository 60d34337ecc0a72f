// Conservative motions over their energy, against closed forms and Code_Aster's nonlinear modes.
#include <doctest/doctest.h>

#include <fmt/core.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "base/eigen_dense.hpp"
#include "behaviour/one_mass.hpp"
#include "behaviour/rates.hpp"
#include "signorini/orbit.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

/// Code_Aster SDND122: m = 1 on k = 10, a stop of kc = 50 at y0 = 0.01 to one side.
std::string one_stop() {
  return matrix_scene("t_end = 30.0\nengine = \"exact\"\ninitial = { u = [-0.03], v = [0.0] }",
                      "mass = [[1.0]]\nstiffness = [[10.0]]",
                      "law = \"compliant\"\nnormal = { d0 = -1.0 }\ngap = 0.01\nnormal_stiffness = 50.0",
                      "[[output]]\nname = \"x\"\nkind = \"displacement\"\ndirection = { d0 = 1.0 }\n");
}

/// 1/f: y0/B = 1/sqrt(2 e (k + kc)/k - kc/k), e = E/(k y0^2), is the cosine of the contact's phase.
double period_of_one_stop(double E, double kc = 50.0, double y0 = 0.01) {
  const double k = 10.0, e = E / (k * y0 * y0), stiffer = (k + kc) / k;
  if (2.0 * e <= 1.0) return 2.0 * std::numbers::pi / std::sqrt(k);
  const double free = 2.0 * std::acos(-1.0 / std::sqrt(2.0 * e));
  const double closed = 2.0 / std::sqrt(stiffer) * std::acos(1.0 / std::sqrt(2.0 * e * stiffer - kc / k));
  return (free + closed) / std::sqrt(k);
}

/// Code_Aster SDND123: two masses of 1 in a chain on springs of 1, stops of 30 at +-1 of the first; from (u, slope u).
std::string two_stops(double u, double slope) {
  return matrix_scene(
      fmt::format("t_end = 60.0\nengine = \"exact\"\ninitial = {{ u = [{:.17g}, {:.17g}], v = [0.0, 0.0] }}",
                  u, u * slope),
      "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[2.0, -1.0], [-1.0, 1.0]]",
      "law = \"compliant\"\nnormal = { d0 = -1.0 }\ngap = 1.0\nnormal_stiffness = 30.0",
      "[[contacts]]\nname = \"d\"\nlaw = \"compliant\"\nnormal = { d0 = 1.0 }\ngap = 1.0\n"
      "normal_stiffness = 30.0\n");
}

/// The same with stops as Code_Aster regularises them, by Runge and Kutta from rest to u = 0 after a quarter of the period:
///   F (F - k (u - 1)) (F - k (u + 1)) = -eta k^2 u,     F = eta u/(1 - u^2) + ... between the stops
struct RegularStop {
  double eta;
  static constexpr double k = 30.0;

  [[nodiscard]] double force(double u) const {
    const double a = std::abs(u);
    double F = a < 0.9 ? eta * a / (1.0 - a * a) : std::max(0.0, k * (a - 1.0)) + 0.5 * std::sqrt(eta * k);
    for (int i = 0; i < 100; ++i) {
      const double p = F - k * (a - 1.0), q = F - k * (a + 1.0);
      const double step = (F * p * q + eta * k * k * a) / (p * q + F * (p + q));
      F -= step;
      if (std::abs(step) <= 1e-15 * (1.0 + F)) break;
    }
    return std::copysign(F, u);
  }
  using State = Eigen::Vector4d;  // u, v
  [[nodiscard]] State rates(const State& y) const {
    return {y[2], y[3], y[1] - 2.0 * y[0] - force(y[0]), y[0] - y[1]};
  }
  static constexpr int steps = 800;
  /// u after a quarter, and the energy: x = (u1, u2, quarter).
  [[nodiscard]] Eigen::Vector3d quarter(const Eigen::Vector3d& x) const {
    State y{x[0], x[1], 0.0, 0.0};
    const double h = x[2] / steps, du = x[0] / steps;
    double stored = x[0] * x[0] - x[0] * x[1] + 0.5 * x[1] * x[1];
    for (int i = 0; i < steps; ++i) {
      const State a = rates(y), b = rates(y + 0.5 * h * a), c = rates(y + 0.5 * h * b), d = rates(y + h * c);
      y += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
      stored += du / 6.0 * (force(i * du) + 4.0 * force((i + 0.5) * du) + force((i + 1.0) * du));
    }
    return {y[0], y[1], stored};
  }
  [[nodiscard]] double frequency(double E) const {
    Eigen::Vector3d x{std::sqrt(E / 1.809), -0.618 * std::sqrt(E / 1.809), 0.97};
    if (E > 1.809) x = {1.13, -0.42, 0.83};
    for (int i = 0; i < 30; ++i) {
      const Eigen::Vector3d wanted{0.0, 0.0, E}, r = quarter(x) - wanted;
      Eigen::Matrix3d J;
      for (int j = 0; j < 3; ++j)
        J.col(j) = (quarter(x + 1e-6 * Eigen::Vector3d::Unit(j)) - wanted - r) / 1e-6;
      const Eigen::Vector3d step = base::solve_dense(J, r);
      x -= step;
      if (step.norm() <= 1e-10) break;
    }
    return 0.25 / x[2];
  }
};

}  // namespace

TEST_SUITE_BEGIN("behaviour/orbit energies");

TEST_CASE("the period of a mass before a stop, at Code_Aster's energy: SDND122 with kc/k kept") {
  const double E = 0.00650108331626;
  OrbitOptions options;
  options.energy = E;
  const Orbit orbit = find_orbit(reader_of_text(one_stop()), options);
  CAPTURE(orbit.reason);
  REQUIRE(orbit.found);
  CHECK(std::abs(orbit.period - period_of_one_stop(E)) <= 1e-10 * orbit.period);
  CHECK(std::abs(1.0 / orbit.period - 0.646631) <= 5e-7);  // printed without kc/k: 0.646217
}

TEST_CASE("a branch over the energy is the backbone of a mass before a stop, from below the gap on") {
  BranchOptions options;
  options.path = "energy";
  options.orbit.period = 2.0;  // a first guess: below the gap no event shows a period
  options.from = 0.0003;
  options.to = 0.02;
  options.step = 0.1;
  const Branch branch = continue_branch(reader_of_text(one_stop()), options);
  CAPTURE(branch.end);
  REQUIRE(branch.complete);
  REQUIRE(branch.points.size() > 5);
  for (const BranchPoint& p : branch.points) {
    const double E = p.parameter, T = period_of_one_stop(E);
    CAPTURE(E);
    CHECK(std::abs(p.period - T) <= 1e-8 * T);
    CHECK(std::abs(5.0 * p.minima.front() * p.minima.front() - E) <= 1e-8 * E);  // the free side: k x^2/2
    CHECK(p.events == (E > 0.0005 ? 2 : 0));
  }
  CHECK(branch.points.back().parameter == 0.02);
}

TEST_CASE(
    "a branch over a key holds the energy that --energy gives: the period is the closed form's at each "
    "point") {
  const double E = 0.00650108331626;
  for (const auto& [path, from, to] : {std::tuple{"contacts.c.normal_stiffness", 50.0, 400.0},
                                       {"contacts.c.normal_stiffness", 50.0, 3.0},
                                       {"contacts.c.gap", 0.01, 0.05},
                                       {"contacts.c.gap", 0.01, -0.01}}) {
    CAPTURE(path);
    CAPTURE(to);
    BranchOptions options;
    options.path = path;
    options.from = from;
    options.to = to;
    options.step = 0.1;
    options.orbit.energy = E;
    const Branch branch = continue_branch(reader_of_text(one_stop()), options);
    CAPTURE(branch.end);
    CHECK(branch.complete);
    REQUIRE(branch.points.size() > 5);
    CHECK(branch.points.back().parameter == to);
    const bool stiffness = std::string(path) != "contacts.c.gap";
    for (const BranchPoint& p : branch.points) {
      CAPTURE(p.parameter);
      const double kc = stiffness ? p.parameter : 50.0, y0 = stiffness ? 0.01 : p.parameter;
      const double T = period_of_one_stop(E, kc, y0);
      if (y0 > 0.0) CHECK(std::abs(p.period - T) <= 1e-8 * T);
      if (y0 > 0.0) CHECK(std::abs(5.0 * p.minima.front() * p.minima.front() - E) <= 1e-8 * E);
      const double y = p.minima.front(), pressed = std::max(0.0, y - y0);
      if (y0 <= 0.0) CHECK(std::abs(5.0 * y * y + 25.0 * pressed * pressed - E) <= 1e-8 * E);
    }
  }
}

TEST_CASE("energies of a branch are above 0, and given once") {
  BranchOptions options;
  options.path = "energy";
  options.from = 0.02;
  options.to = 0.0;
  CHECK_THROWS_AS(continue_branch(reader_of_text(one_stop()), options), UsageError);
  options.to = 0.01;
  options.orbit.energy = 0.015;
  CHECK_THROWS_AS(continue_branch(reader_of_text(one_stop()), options), UsageError);
}

TEST_CASE(
    "Code_Aster's SDND123, two masses between two stops: f is that of the regularised stop, which tends to "
    "ours") {
  // Below E = omega^2 (1 + 0.618^2)/2 = 1.809 the second mode touches no stop: f is that of the linear structure.
  // Code_Aster prints 1.5e-3 more at E = 1.19768: its stop pulls before it is reached (RegularStop).
  const double square = 0.5 * (3.0 + std::sqrt(5.0)), slope = 2.0 - square;
  const double linear = std::sqrt(square) / (2.0 * std::numbers::pi),
               touches = 0.5 * square * (1.0 + slope * slope);
  CHECK(std::abs(RegularStop{0.005}.frequency(1.19768) / 0.257905285 - 1.0) <= 1e-6);
  for (const double E : {1.19768, 2.1}) {
    CAPTURE(E);
    OrbitOptions options;
    options.energy = E;
    options.period = E < touches ? 3.88 : 3.3;
    const Orbit orbit =
        find_orbit(reader_of_text(two_stops(E < touches ? 0.8 : 1.13, E < touches ? slope : -0.37)), options);
    CAPTURE(orbit.reason);
    REQUIRE(orbit.found);
    CHECK(orbit.sequence.size() == (E < touches ? 0u : 4u));
    if (E < touches) CHECK(std::abs(1.0 / orbit.period - linear) <= 1e-10);
    double before = 1.0;
    for (const double eta : {5e-3, 5e-4, 5e-5}) {
      CAPTURE(eta);
      const double off = std::abs(RegularStop{eta}.frequency(E) * orbit.period - 1.0);
      CHECK(off <= 0.3 * before);
      before = off;
    }
    CHECK(before <= 2e-4);
  }
}

TEST_CASE(
    "a branch over the energy of two masses between two stops: linear below the energy of contact, faster "
    "above it") {
  const double square = 0.5 * (3.0 + std::sqrt(5.0)), slope = 2.0 - square,
               f = std::sqrt(square) / (2.0 * std::numbers::pi);
  BranchOptions options;
  options.path = "energy";
  options.from = 1.19768;
  options.to = 2.0;
  options.step = 0.1;
  options.orbit.period = 3.88;
  const Branch branch = continue_branch(reader_of_text(two_stops(0.8, slope)), options);
  CAPTURE(branch.end);
  REQUIRE(branch.complete);
  const double touches = 0.5 * square * (1.0 + slope * slope);
  for (const BranchPoint& p : branch.points) {
    CAPTURE(p.parameter);
    CHECK(p.events == (p.parameter <= touches ? 0 : 4));
    if (p.parameter <= touches)
      CHECK(std::abs(1.0 / p.period - f) <= 1e-10);
    else
      CHECK(1.0 / p.period > f);
  }
}

TEST_CASE(
    "below the energy of contact the period is the least one, not a multiple: a mass before an elastic stop, "
    "turned") {
  // Springs of 2.1 and 16.317 N/m on 1.3 kg; the motion along the soft one has 2 pi sqrt(m/k). Closing after three of these
  // periods means nothing.
  const double m = 1.3, soft = 2.1, hard = 16.317, gap = 0.3, E = 0.05;
  for (const double angle : {0.0, 0.61}) {
    CAPTURE(angle);
    const double c = std::cos(angle), s = std::sin(angle);
    const std::string text = matrix_scene(
        fmt::format(
            "t_end = 40.0\nengine = \"exact\"\ninitial = {{ u = [0.0, 0.0], v = [{:.17g}, {:.17g}] }}",
            1.2 * c, 1.2 * s),
        fmt::format(
            "mass = [[{0}, 0.0], [0.0, {0}]]\nstiffness = [[{1:.17g}, {2:.17g}], [{2:.17g}, {3:.17g}]]", m,
            soft * c * c + hard * s * s, (soft - hard) * c * s, soft * s * s + hard * c * c),
        fmt::format("law = \"rigid\"\nnormal = {{ d0 = {:.17g}, d1 = {:.17g} }}\ngap = {}\nrestitution = 1.0",
                    -c, -s, gap));
    OrbitOptions options;
    options.energy = E;
    const Orbit orbit = find_orbit(reader_of_text(text), options);
    CAPTURE(orbit.reason);
    REQUIRE(orbit.found);
    const double T = 2.0 * std::numbers::pi * std::sqrt(m / soft);
    CHECK(std::abs(orbit.period - T) <= 1e-10 * T);
    CHECK(orbit.sequence.empty());
    // A multiple that was asked for stays one.
    options.times = 2;
    options.period = T;
    const Orbit twice = find_orbit(reader_of_text(text), options);
    if (twice.found) CHECK(std::abs(std::remainder(twice.period, T)) <= 1e-9 * T);
  }
}

TEST_SUITE_END();
