#include "motion/taylor.hpp"

#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <limits>

#include "behaviour/one_mass.hpp"
#include "motion/point.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::taylors {
namespace {

/// d0 sticks rigidly to a surface with this velocity and pulls d1 along; d2 between them, without mass.
Model pulled(const std::string& velocity, const std::string& damping) {
  return build_model(parse_scene(
      matrix_scene("t_end = 1.0\ninitial = { u = [0.1, 0.1, 0.03], v = [0.0, -0.2, 0.0] }",
                   "mass = [[1.5, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 0.0]]\n"
                   "damping = [[0.3, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, " +
                       damping +
                       "]]\n"
                       "stiffness = [[12.0, -8.0, -3.0], [-8.0, 15.0, -7.0], [-3.0, -7.0, 11.0]]",
                   "law = \"slider\"\ntangent = { d0 = 0.7 }\nnormal_force = 1.0\nfriction = 50.0\n"
                   "surface_velocity = " +
                       velocity),
      "test.toml"));
}

}  // namespace

TEST_SUITE_BEGIN("unit/motion/taylor");

TEST_CASE("disturbances are irregular, of both signs, and between half of the most and the most") {
  int positive = 0;
  for (std::size_t i = 0; i < 1000; ++i) {
    const double part = motion::DataPerturbation::fraction(i),
                 size = std::abs(part) / (motion::DataPerturbation::max_roundings * 0x1p-52);
    CHECK(size >= 0.5);
    CHECK(size <= 1.0);
    CHECK(part == motion::DataPerturbation::fraction(i));
    CHECK(part != motion::DataPerturbation::fraction(i + 1));
    positive += part > 0.0;
  }
  CHECK(positive > 430);
  CHECK(positive < 570);
}

TEST_CASE("what sticks to a surface follows it to the last digit, beside a part without mass") {
  const std::string moving = "{ type = \"harmonic\", amplitude = 0.7, omega = 3.0 }";
  for (const std::string& velocity : {std::string("0.0"), moving})
    for (const std::string damping : {"0.0", "0.4"}) {
      CAPTURE(velocity);
      CAPTURE(damping);
      const Model model = pulled(velocity, damping);
      const linear::SystemMatrices structure(model);
      motion::StateSystems systems(model, structure);
      const double t = 0.2;
      const motion::StateSystemPtr system = systems.system_of({{State::stick, 0.0}});
      REQUIRE(system);
      const motion::Forcing forcing(model, t, motion::Side::after);
      Vector v = model.v0;
      v[0] = forcing.surface(0, t, 1) / 0.7;
      v[2] = std::numeric_limits<double>::quiet_NaN();  // not read: it has no mass
      motion::Taylor taylor(systems);
      motion::Series series;
      constexpr int levels = 14;
      taylor.expand(system, forcing, t, model.u0, v, levels, 1.0, series);
      double factorial = 1.0;
      for (int k = 2; k <= levels; ++k) {
        CAPTURE(k);
        factorial *= k;
        const double expected = forcing.surface(0, t, k) / 0.7 / factorial;
        CHECK(std::abs(series.u(0, k) - expected) <= 4e-16 * std::abs(expected));
      }
      // The equations of d1 and d2, and T of d0's, by the coefficients of u.
      const double c2 = std::stod(damping);
      for (int k = 0; k <= levels - 4; ++k) {
        CAPTURE(k);
        const auto u = [&](int i, int j) { return series.u(i, j); };
        const auto a = [&](int i) { return (k + 1) * (k + 2) * u(i, k + 2); };
        const double size = std::abs(u(0, k)) + std::abs(u(1, k)) + std::abs(u(2, k));
        CHECK(std::abs(2.0 * a(1) - 8.0 * u(0, k) + 15.0 * u(1, k) - 7.0 * u(2, k)) < 1e-14 * 30.0 * size);
        CHECK(std::abs(c2 * (k + 1) * u(2, k + 1) - 3.0 * u(0, k) - 7.0 * u(1, k) + 11.0 * u(2, k)) <
              1e-14 * 30.0 * size);
        const double sum =
            1.5 * a(0) + 0.3 * (k + 1) * u(0, k + 1) + 12.0 * u(0, k) - 8.0 * u(1, k) - 3.0 * u(2, k);
        CHECK(0.7 * series.forces(1, k) == doctest::Approx(-sum).epsilon(1e-10));
        CHECK(series.forces(0, k) == (k == 0 ? -1.0 : 0.0));
      }
    }
}

TEST_CASE("what is held on a slope does not move at all, whatever pulls at it through a part without mass") {
  for (const double degrees : {3.0, 17.0, 36.0, 59.0, 71.0}) {
    CAPTURE(degrees);
    const double c = std::cos(degrees * M_PI / 180.0), s = std::sin(degrees * M_PI / 180.0);
    const Model model = build_model(parse_scene(
        matrix_scene(
            "t_end = 1.0\ninitial = { u = [0.0, 0.0, 0.1, 0.0], v = [0.0, 0.0, -0.2, 0.0] }",
            "mass = [[1.7, 0.0, 0.0, 0.0], [0.0, 1.3, 0.0, 0.0], [0.0, 0.0, 2.1, 0.0], [0.0, 0.0, 0.0, "
            "0.0]]\n"
            "stiffness = [[13.0, -1.7, -2.9, -3.1], [-1.7, 12.0, -1.1, -2.3], [-2.9, -1.1, 9.0, -0.7], "
            "[-3.1, -2.3, -0.7, 11.0]]",
            fmt::format("law = \"rigid\"\nrestitution = 0.0\nfriction = 50.0\n"
                        "normal = {{ d0 = {}, d1 = {} }}\ntangent = {{ d0 = {}, d1 = {} }}",
                        s, c, c, -s)),
        "test.toml"));
    const linear::SystemMatrices structure(model);
    motion::StateSystems systems(model, structure);
    const motion::StateSystemPtr system = systems.system_of({{State::stick, 0.0}});
    REQUIRE(system);
    motion::Taylor taylor(systems);
    motion::Series series;
    taylor.expand(system, motion::Forcing(model, 0.0, motion::Side::after), 0.0, model.u0, model.v0, 14, 1.0,
                  series);
    for (int k = 2; k <= 14; ++k) {
      CHECK(series.u(0, k) == 0.0);
      CHECK(series.u(1, k) == 0.0);
    }
    CHECK(std::abs(series.u(2, 2)) > 1e-3);
  }
}

TEST_CASE(
    "what a load pulls at does not move while it is held, beside a part without mass that it does not "
    "touch") {
  std::vector<std::string> contacts;
  for (const double t : {0.3, 0.7, 0.9, 1.3})
    contacts.push_back(
        fmt::format("law = \"slider\"\nnormal_force = 1.0\nfriction = 50.0\ntangent = {{ d0 = {} }}", t));
  for (const double degrees : {3.0, 17.0, 36.0, 59.0}) {
    const double c = std::cos(degrees * M_PI / 180.0), s = std::sin(degrees * M_PI / 180.0);
    contacts.push_back(
        fmt::format("law = \"rigid\"\nrestitution = 0.0\nfriction = 50.0\n"
                    "normal = {{ d0 = {}, d1 = {} }}\ntangent = {{ d0 = {}, d1 = {} }}",
                    s, c, c, -s));
  }
  for (const std::string& contact : contacts) {
    CAPTURE(contact);
    const bool slope = contact.find("normal =") != std::string::npos;
    const Model model = build_model(parse_scene(
        matrix_scene("t_end = 1.0\ninitial = { u = [0.0, 0.0, 0.1, 0.0], v = [0.0, 0.0, -0.2, 0.0] }",
                     fmt::format("mass = [[1.7, 0.0, 0.0, 0.0], [0.0, 1.3, 0.0, 0.0], [0.0, 0.0, 2.1, 0.0], "
                                 "[0.0, 0.0, 0.0, 0.0]]\n"
                                 "stiffness = [[13.0, {0}, 0.0, 0.0], [{0}, 12.0, 0.0, 0.0], [0.0, 0.0, 9.0, "
                                 "-0.7], [0.0, 0.0, -0.7, 11.0]]",
                                 slope ? -1.7 : 0.0),
                     contact,
                     "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 2.3\nhistory = { type = \"harmonic\", "
                     "omega = 3.0, phase = 0.4 }\n"),
        "test.toml"));
    const linear::SystemMatrices structure(model);
    motion::StateSystems systems(model, structure);
    const motion::StateSystemPtr system = systems.system_of({{State::stick, 0.0}});
    REQUIRE(system);
    motion::Taylor taylor(systems);
    motion::Series series;
    taylor.expand(system, motion::Forcing(model, 0.0, motion::Side::after), 0.0, model.u0, model.v0, 14, 1.0,
                  series);
    const Combination& t = model.contacts[0].tangent;
    Vector along = Vector::Zero(4);
    t.add_to(along, 1.0);
    for (int k = 2; k <= 14; ++k) {
      CAPTURE(k);
      CHECK(series.u(0, k) == 0.0);
      if (slope) CHECK(series.u(1, k) == 0.0);
    }
    // p = t T but for what n carries, at right angles to t
    CHECK(series.forces(1, 0) == doctest::Approx(2.3 * std::sin(0.4) * t.terms[0].second / t.dot(along)));
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::taylors
