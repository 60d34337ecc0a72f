// Derivatives of runs whose friction depends on the slip rate, against differences of the runs. Slips end fast, so that
// the coefficient changes within a small part of a slip.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "behaviour/one_mass.hpp"
#include "behaviour/orbit_runs.hpp"
#include "behaviour/rates.hpp"
#include "signorini/fit.hpp"

namespace signorini::tests::slip_rate_tangents {
namespace {

/// A mass that passes zero slip rate at 280 m/s^2: Stribeck's friction changes within 7e-5 s.
const std::string fast_reversals = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 2.0
engine = "ida"
output_dt = 0.25
rtol = 1e-12
initial = { a = { ux = -1.85, vx = 29.9 } }
[nodes]
a = [0.0, 0.0]
[[masses]]
node = "a"
mass = 0.561
[[springs]]
node = "a"
direction = [1.0, 0.0]
stiffness = 38.964
damping = 0.1
[[springs]]
node = "a"
direction = [0.0, 1.0]
stiffness = 30.0
damping = 1.0
[[contacts]]
name = "c"
node = "a"
law = "slider"
tangent = [1.0, 0.0]
normal_force = 5.43
friction = { static = 0.25, kinetic = 0.1, stribeck_velocity = 0.02 }
[[loads]]
node = "a"
direction = [1.0, 0.1]
amplitude = 11.428
history = { type = "harmonic", omega = 8.067 }
)";

/// A slab on PTFE bearings, shaken.
const std::string slab = R"(schema = 1
units = { force = "kN", mass = "t", length = "m", time = "s" }
[run]
t_end = 3.0
engine = "ida"
rtol = 1e-12
output_dt = 0.25
[nodes]
s = [0.0, 0.0]
[[masses]]
node = "s"
mass = 80.0
[[supports]]
node = "s"
fix = ["uy"]
[[springs]]
node = "s"
direction = [1.0, 0.0]
stiffness = 300.0
[[contacts]]
name = "b"
node = "s"
law = "slider"
tangent = [1.0, 0.0]
normal_force = 800.0
friction = { slow = 0.04, fast = 0.1, velocity = 0.02 }
[[base_motion]]
direction = [1.0, 0.0]
acceleration = { type = "harmonic", omega = 6.0, amplitude = 8.0 }
)";

/// Two masses at odd angles on bearings of different velocities, in kN, kg, mm, ms.
const std::string two_bearings = R"(schema = 1
units = { force = "kN", mass = "kg", length = "mm", time = "ms" }
[run]
t_end = 1500.0
engine = "ida"
rtol = 1e-12
output_dt = 250.0
[nodes]
base = [0.0, 0.0]
top = [0.0, 3000.0]
[[masses]]
node = "base"
mass = 61000.0
[[masses]]
node = "top"
mass = 137000.0
[[springs]]
node = "base"
direction = [0.93, 0.367]
stiffness = 2.3
damping = 40.0
[[springs]]
node = "base"
direction = [-0.367, 0.93]
stiffness = 41.0
damping = 300.0
[[springs]]
node = "top"
against = "base"
direction = [0.8, 0.6]
stiffness = 61.0
damping = 210.0
[[springs]]
node = "top"
against = "base"
direction = [-0.6, 0.8]
stiffness = 44.0
damping = 130.0
[[contacts]]
name = "left"
node = "base"
law = "slider"
tangent = [0.91, 0.41]
normal_force = 810.0
friction = { slow = 0.043, fast = 0.117, velocity = 0.0031 }
[[contacts]]
name = "right"
node = "top"
law = "slider"
tangent = [0.97, -0.22]
normal_force = 655.0
friction = { slow = 0.031, fast = 0.094, velocity = 0.0057 }
[[base_motion]]
direction = [0.83, 0.557]
acceleration = { type = "harmonic", omega = 0.0053, amplitude = 0.0063 }
)";

/// A block on a bearing whose normal force varies, in N, t, mm, s.
const std::string pad = R"(schema = 1
units = { force = "N", mass = "t", length = "mm", time = "s" }
[run]
t_end = 2.0
engine = "ida"
rtol = 1e-12
output_dt = 0.25
[nodes]
s = [0.0, 0.0]
[[masses]]
node = "s"
mass = 42.0
[[springs]]
node = "s"
direction = [0.94, 0.342]
stiffness = 210.0
damping = 9.0
[[springs]]
node = "s"
direction = [-0.342, 0.94]
stiffness = 9100.0
damping = 90.0
[[contacts]]
name = "pad"
node = "s"
law = "slider"
tangent = [0.96, 0.28]
normal_force = { type = "harmonic", offset = 4.1e5, amplitude = 1.7e5, omega = 17.3 }
friction = { slow = 0.03, fast = 0.11, velocity = 9.0 }
[[base_motion]]
direction = [0.94, 0.342]
acceleration = { type = "harmonic", omega = 7.1, amplitude = 3900.0 }
)";

/// A block on a rigid plate, pushed down by a load that varies: N follows from the motion.
const std::string plate = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 2.0
engine = "ida"
rtol = 1e-12
output_dt = 0.25
initial = { s = { ux = 0.31, uy = 0.0 } }
[nodes]
s = [0.0, 0.0]
[[masses]]
node = "s"
mass = 2.3
[[springs]]
node = "s"
direction = [0.8, 0.6]
stiffness = 140.0
damping = 0.3
[[loads]]
node = "s"
direction = [0.28, -0.96]
amplitude = 19.0
[[loads]]
node = "s"
direction = [0.28, -0.96]
amplitude = 5.0
history = { type = "harmonic", omega = 11.3 }
[[contacts]]
name = "c"
node = "s"
law = "rigid"
restitution = 0.0
normal = [0.0, 1.0]
friction = { static = 0.32, kinetic = 0.12, stribeck_velocity = 0.013 }
)";

/// Numbers of a run in one list: by quantity, then by event or row.
using Numbers = std::vector<std::vector<double>>;

Numbers values_in(const Result& run) {
  Numbers all(2);
  for (const Event& e : run.events) {
    all[0].push_back(e.t);
    all[1].push_back(e.contact < 0 ? 0.0 : e.T_after);
  }
  for (Eigen::Index i = 0; i < run.rows.front().u.size(); ++i) {
    std::vector<double>&u = all.emplace_back(), &v = all.emplace_back();
    for (const auto& row : run.rows) {
      u.push_back(row.u[i]);
      v.push_back(row.v[i]);
    }
  }
  return all;
}

Numbers rates_in(const Sensitivities& s) {
  Numbers all(2);
  for (std::size_t i = 0; i < s.events.size(); ++i) {
    all[0].push_back(s.event_rates[i][0].t);
    all[1].push_back(s.events[i].contact < 0 ? 0.0 : s.event_rates[i][0].T_after);
  }
  std::array<std::vector<std::size_t>, 2> columns;  // of displacements and of velocities
  for (std::size_t i = 0; i < s.columns.size(); ++i)
    for (const char* direction : {"x", "y"}) {
      if (s.columns[i].ends_with(std::string(".u") + direction)) columns[0].push_back(i);
      if (s.columns[i].ends_with(std::string(".v") + direction)) columns[1].push_back(i);
    }
  for (std::size_t i = 0; i < columns[0].size(); ++i)
    for (const auto& of : columns) {
      std::vector<double>& one = all.emplace_back();
      for (const auto& row : s.value_rates[0]) one.push_back(row[of[i]]);
    }
  return all;
}

/// Every derivative against differences of sixth order over `relative` of the parameter, in parts of the greatest of its
/// kind.
void check_differences(const std::string& text, const std::string& path, double relative) {
  CAPTURE(path);
  const SceneReader read = reader_of_text(text);
  const Sensitivities s = sensitivities(read, {path});
  CAPTURE(s.parameters[0].reason);
  const double p = s.parameters[0].value, h = relative * p;
  std::vector<Numbers> runs;
  std::size_t events = 0;
  for (const int k : {-3, -2, -1, 1, 2, 3}) {
    const Scene scene = read({{path, fmt::format("{:.17g}", p + k * h)}});
    const Result run = simulate(build_model(scene), scene.run);
    events = run.events.size();
    REQUIRE(events == s.events.size());
    runs.push_back(values_in(run));
  }
  CHECK(s.stretches.taken == 0);  // the followed motion is never off the engine's
  const Numbers found = rates_in(s);
  REQUIRE(found.size() == runs[0].size());
  // Times, forces, displacements, velocities
  std::array<double, 4> greatest_of{}, value_of{};
  const auto kind = [](std::size_t of) { return of < 2 ? of : 2 + of % 2; };
  for (std::size_t of = 0; of < found.size(); ++of) {
    REQUIRE(found[of].size() == runs[0][of].size());
    for (std::size_t i = 0; i < found[of].size(); ++i) {
      greatest_of[kind(of)] = std::max(greatest_of[kind(of)], std::abs(found[of][i]));
      value_of[kind(of)] = std::max(value_of[kind(of)], std::abs(runs[0][of][i]));
    }
  }
  for (std::size_t of = 0; of < found.size(); ++of) {
    CAPTURE(of);
    const double greatest = greatest_of[kind(of)], value = value_of[kind(of)];
    for (std::size_t i = 0; i < found[of].size(); ++i) {
      CAPTURE(i);
      const auto x = [&](std::size_t run) { return runs[run][of][i]; };
      const double expected = (45.0 * (x(3) - x(2)) - 9.0 * (x(4) - x(1)) + (x(5) - x(0))) / (60.0 * h);
      // The second term: rounding and tolerance of the runs.
      CHECK(std::abs(found[of][i] - expected) <= 1e-5 * greatest + 1e-10 * value / h);
    }
  }
}

/// The mass of `fast_reversals` with rising friction, turned by an angle.
std::string turned(double angle) {
  const double x = std::cos(angle), y = std::sin(angle);
  const auto matrix = [&](double a, double b) {
    return fmt::format("[[{0:.17g}, {1:.17g}], [{1:.17g}, {2:.17g}]]", a * x * x + b * y * y, (a - b) * x * y,
                       a * y * y + b * x * x);
  };
  return matrix_scene(
      "t_end = 7.788750845642229\nengine = \"ida\"\nrtol = 1e-12",
      "mass = " + matrix(0.561, 0.561) + "\nstiffness = " + matrix(38.964, 30.0) +
          "\ndamping = " + matrix(0.1, 1.0),
      fmt::format("law = \"slider\"\ntangent = {{ d0 = {:.17g}, d1 = {:.17g} }}\nnormal_force = 5.43\n"
                  "friction = {{ slow = 0.1, fast = 0.25, velocity = 0.2 }}",
                  x, y),
      fmt::format(
          "[[loads]]\ndirection = {{ d0 = {:.17g}, d1 = {:.17g} }}\namplitude = {:.17g}\nhistory = {{ "
          "type = \"harmonic\", omega = 8.067 }}",
          x - 0.1 * y, y + 0.1 * x, 11.428 / std::hypot(1.0, 0.1)));
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/sensitivity_slip_rate");

TEST_CASE("a block stops on Stribeck's friction: the time by v_s in closed form, from 30 to 3e5 v_s") {
  // t = (m/N) int_0^v0 dx / (fk + (fs - fk) exp(-x/v_s)),   dt/dv_s = m/(N fk) ln(fk/fs) up to exp(-v0/v_s)
  const double expected = 1.3 / (17.0 * 0.12) * std::log(0.12 / 0.32);
  for (const double v : {0.1, 0.03, 1e-3, 1e-4, 1e-5})
    for (const int s : {1, -1}) {
      CAPTURE(v);
      CAPTURE(s);
      const Sensitivities found = rates_of(
          matrix_scene(
              fmt::format("t_end = 2.5\nengine = \"ida\"\nrtol = 1e-10\ninitial = {{ u = [0.0], v = [{}] }}",
                          3 * s),
              "mass = [[1.3]]\nstiffness = [[0.0]]",
              fmt::format("law = \"slider\"\ntangent = {{ d0 = 1.0 }}\nnormal_force = 17.0\n"
                          "friction = {{ static = 0.32, kinetic = 0.12, stribeck_velocity = {} }}",
                          v)),
          {"contacts.c.friction.stribeck_velocity"});
      REQUIRE(!found.events.empty());
      CHECK(found.event_rates[0][0].t == doctest::Approx(expected).epsilon(1e-9));
    }
}

TEST_CASE("a mass that reverses fast under Stribeck's friction") {
  check_differences(fast_reversals, "contacts.c.friction.stribeck_velocity", 0.02);
  check_differences(fast_reversals, "contacts.c.friction.kinetic", 0.01);
  check_differences(fast_reversals, "springs.1.stiffness", 1e-3);
}

TEST_CASE("a slab on bearings whose friction rises with the slip rate") {
  for (const char* constant : {"velocity", "slow", "fast"})
    check_differences(slab, std::string("contacts.b.friction.") + constant, 5e-3);
  check_differences(slab, "masses.1.mass", 1e-3);
}

TEST_CASE("a fit finds the bearings' friction again from rows of a run") {
  const Sensitivities truth = rates_of(slab, {});
  const SceneReader wrong = [](const std::vector<Override>& changes) {
    std::vector<Override> all{{"contacts.b.friction.velocity", "0.026"},
                              {"contacts.b.friction.fast", "0.093"}};
    all.insert(all.end(), changes.begin(), changes.end());
    return reader_of_text(slab)(all);
  };
  Measurements data;
  for (std::size_t i = 1; i < truth.times.size(); ++i)
    data.rows.push_back({0, "", truth.columns[0], truth.times[i], truth.values[i][0], 1.0});
  const Fit found = fit(wrong, {"contacts.b.friction.velocity", "contacts.b.friction.fast"}, data);
  CAPTURE(found.reason);
  CHECK(found.converged);
  CHECK(std::abs(found.keys[0].value - 0.02) < 1e-7);
  CHECK(std::abs(found.keys[1].value - 0.1) < 1e-8);
}

TEST_CASE("two masses at odd angles on bearings of different velocities") {
  for (const char* path : {"contacts.left.friction.velocity", "contacts.right.friction.velocity",
                           "contacts.right.friction.fast"})
    check_differences(two_bearings, path, 5e-3);
  check_differences(two_bearings, "base_motion.1.acceleration.amplitude", 1e-3);
}

TEST_CASE("a block on a bearing whose normal force varies") {
  for (const char* path : {"contacts.pad.friction.velocity", "contacts.pad.friction.slow"})
    check_differences(pad, path, 5e-3);
  check_differences(pad, "contacts.pad.normal_force.amplitude", 5e-3);
}

TEST_CASE("a block on a rigid plate under Stribeck's friction") {
  for (const char* constant : {"stribeck_velocity", "kinetic"})
    check_differences(plate, std::string("contacts.c.friction.") + constant, 5e-3);
  check_differences(plate, "masses.1.mass", 1e-3);
}

TEST_CASE("multipliers of an orbit that reverses fast are those of differences of the map, at any angle") {
  for (const double angle : {0.0, 0.71, -2.3}) {
    CAPTURE(angle);
    const std::string text = turned(angle);
    const Orbit orbit = find_orbit(reader_of_text(text));
    CAPTURE(orbit.reason);
    REQUIRE(orbit.found);
    REQUIRE(orbit.multipliers.size() == 4);
    // By the variational equation with its jumps in another program.
    const std::complex<double> known(0.8968657, 0.1879498);
    CHECK(std::abs(orbit.multipliers[0] - known) <= 1e-7);
    CHECK(std::abs(orbit.multipliers[1] - std::conj(known)) <= 1e-7);
    std::array<Eigen::MatrixXd, 3> by;  // over h, 2 h, 4 h
    for (int i = 0; i < 3; ++i)
      by[static_cast<std::size_t>(i)] = monodromy_by_runs(text, orbit, 2, 4e-3 * (1 << i));
    const Eigen::MatrixXd phi = (64.0 * by[0] - 20.0 * by[1] + by[2]) / 45.0;
    const Eigen::VectorXcd expected = Eigen::EigenSolver<Eigen::MatrixXd>(phi, false).eigenvalues();
    for (const auto& mu : orbit.multipliers) {
      CAPTURE(mu.real());
      CHECK((expected.array() - mu).abs().minCoeff() <= 1e-7);
    }
    CHECK(orbit.multiplier_error <= 1e-8);
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::slip_rate_tangents
