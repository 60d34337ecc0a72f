// Multipliers on and near the unit circle, against closed forms: their stated error, and what is decided from them.
#include <doctest/doctest.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "behaviour/one_mass.hpp"
#include "behaviour/rates.hpp"
#include "signorini/orbit.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

constexpr double spring_mass = 1.3, soft_spring = 2.1, hard_spring = 16.317;

/// A mass on two springs at right angles, turned by an angle; c: damper beside the soft one, half of it beside the hard one. The
/// stop is out of reach.
std::string turned_springs(double angle, double c, double w) {
  const double x = std::cos(angle), y = std::sin(angle);
  const auto matrix = [&](double a, double b) {
    return fmt::format("[[{:.17g}, {:.17g}], [{:.17g}, {:.17g}]]", a * x * x + b * y * y, (a - b) * x * y,
                       (a - b) * x * y, a * y * y + b * x * x);
  };
  return matrix_scene("t_end = 30.0\nengine = \"exact\"",
                      "mass = " + matrix(spring_mass, spring_mass) +
                          "\nstiffness = " + matrix(soft_spring, hard_spring) +
                          (c > 0.0 ? "\ndamping = " + matrix(c, 0.5 * c) : ""),
                      "law = \"rigid\"\nnormal = { d0 = -1.0 }\ngap = 1000.0",
                      fmt::format("[[loads]]\ndirection = {{ d0 = {:.17g}, d1 = {:.17g} }}\namplitude = 0.9\n"
                                  "history = {{ type = \"harmonic\", omega = {}, phase = 0.4 }}\n",
                                  x, y, w));
}

/// exp((-c/2m +- i sqrt(k/m - (c/2m)^2)) T)
std::complex<double> multiplier_of_spring(double k, double c, double T) {
  const double decay = 0.5 * c / spring_mass;
  return std::exp(std::complex<double>(-decay * T, std::sqrt(k / spring_mass - decay * decay) * T));
}

/// A mass before a compliant stop: nothing takes energy.
std::string elastic_stop(double angle) {
  return fmt::format(
      "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\n[run]\nt_end = "
      "40.0\n"
      "engine = \"exact\"\ninitial = {{ A = {{ vx = {0:.17g}, vy = {1:.17g} }} }}\n[nodes]\nA = [0.0, 0.0]\n"
      "[[masses]]\nnode = \"A\"\nmass = 1.3\n[[springs]]\nnode = \"A\"\ndirection = [{3:.17g}, {2:.17g}]\n"
      "stiffness = 16.317\n[[springs]]\nnode = \"A\"\ndirection = [{2:.17g}, {4:.17g}]\nstiffness = 2.1\n"
      "[[contacts]]\nname = \"stop\"\nnode = \"A\"\nlaw = \"compliant\"\nnormal = [{5:.17g}, {3:.17g}]\ngap "
      "= 0.3\n"
      "normal_stiffness = 9.0\n",
      1.2 * std::cos(angle), 1.2 * std::sin(angle), std::cos(angle), -std::sin(angle), std::sin(angle),
      -std::cos(angle));
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/orbit multipliers");

TEST_CASE(
    "multipliers are within their stated error of the closed form; without dampers nothing is decided") {
  struct Case {
    double angle, c, w;
  };
  for (const auto& [angle, c, w] : {Case{0.0, 0.0, 1.7}, Case{0.58, 0.0, 0.5}, Case{0.58, 0.0, 0.17},
                                    Case{0.0, 1e-3, 0.05}, Case{0.58, 0.17, 1.7}}) {
    CAPTURE(angle);
    CAPTURE(c);
    CAPTURE(w);
    const Orbit orbit = find_orbit(reader_of_text(turned_springs(angle, c, w)));
    CAPTURE(orbit.reason);
    REQUIRE(orbit.found);
    REQUIRE(orbit.multipliers.size() == 4);
    double error = 0.0;
    for (const auto& mu : orbit.multipliers) {
      double nearest = 10.0;
      for (const auto& right : {multiplier_of_spring(soft_spring, c, orbit.period),
                                multiplier_of_spring(hard_spring, 0.5 * c, orbit.period)})
        nearest = std::min({nearest, std::abs(mu - right), std::abs(mu - std::conj(right))});
      error = std::max(error, nearest);
    }
    CAPTURE(error);
    CAPTURE(orbit.multiplier_error);
    CHECK(error <= orbit.multiplier_error);
    CHECK(orbit.multiplier_error <= 1e-8);  // and it is worth something
    CHECK(orbit.stable.has_value() == (c > 0.0));
    if (c > 0.0) CHECK(*orbit.stable);
    CHECK(orbit.loss == OrbitLoss::none);
  }
}

TEST_CASE("conservative orbits are not stable or lost by rounding: over their energy, and over a key") {
  for (const double angle : {0.0, 0.58}) {
    CAPTURE(angle);
    OrbitOptions low;
    low.energy = 0.01;  // below the stop: a linear oscillator
    const Orbit linear = find_orbit(reader_of_text(elastic_stop(angle)), low);
    CAPTURE(linear.reason);
    REQUIRE(linear.found);
    CHECK(!linear.stable);
    const auto check = [](const Branch& branch) {
      CAPTURE(branch.end);
      REQUIRE(branch.points.size() > 5);
      for (const BranchPoint& p : branch.points) {
        CAPTURE(p.parameter);
        CAPTURE(p.max_multiplier);
        CHECK(!p.stable);
        CHECK(p.loss == OrbitLoss::none);
        CHECK(p.special == "");
      }
    };
    BranchOptions options;
    options.path = "energy";
    options.from = 0.3;
    options.to = 2.0;
    options.step = 0.1;
    check(continue_branch(reader_of_text(elastic_stop(angle)), options));
    options.path = "springs.2.stiffness";
    options.from = 2.1;
    options.to = 3.0;
    options.orbit.energy = 0.3;
    options.most_points = 8;
    check(continue_branch(reader_of_text(elastic_stop(angle)), options));
  }
}

TEST_SUITE_END();
