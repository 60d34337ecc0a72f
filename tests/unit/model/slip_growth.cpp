// Contacts that slip and drive an oscillation, or away: closed forms of one mass.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <complex>

#include "model/slip_growth.hpp"

namespace signorini::tests::slip_growth_tests {
namespace {

/// A mass of 2 on K = [[a, c], [c, b]] in (d0, d1), a contact along n = d1, t = d0.
Model block(double a, double b, double c, double friction, double damping, double tangent = 0.0) {
  return build_model(parse_scene(fmt::format(
                                     R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
[run]
t_end = 1.0
[matrices]
mass = [[2.0, 0.0], [0.0, 2.0]]
damping = [[{4}, 0.0], [0.0, {4}]]
stiffness = [[{0}, {2}], [{2}, {1}]]
[[contacts]]
name = "pad"
law = "compliant"
normal = {{ d1 = 1.0 }}
tangent = {{ d0 = 1.0, d1 = {5} }}
normal_stiffness = 1000.0
tangential_stiffness = 1000.0
friction = {3}
)",
                                     a, b, c, friction, damping, tangent),
                                 "test.toml"));
}

}  // namespace

TEST_SUITE_BEGIN("unit/model/slip_growth");

TEST_CASE("flutter of one mass: frequencies that friction brings together") {
  // K_slip = [[a, c - s f kn], [c, b + kn]]; 2 l^2 = -(m +- sqrt(d^2 + c (c - s f kn)))
  const double a = 1000.0, b = 20.0, c = 30.0, f = 0.4, kn = 1000.0;
  const Model model = block(a, b, c, f, 0.0);
  const auto found = model::slip_growth(model, {State::slip_plus});
  REQUIRE(found);
  const double mean = 0.5 * (a + b + kn), half = 0.5 * (b + kn - a);
  const double turn = std::sqrt(-(half * half + c * (c - f * kn)));
  const std::complex<double> lambda = std::sqrt(-std::complex<double>(mean, turn) / 2.0);
  CHECK(found->rate == doctest::Approx(std::abs(lambda.real())).epsilon(1e-9));
  CHECK(found->omega == doctest::Approx(std::abs(lambda.imag())).epsilon(1e-9));
  CHECK(found->contacts == std::vector<std::size_t>{0});
  // Back it drives nothing: c (c + f kn) > 0; nor where it sticks, is open or has no friction.
  CHECK_FALSE(model::slip_growth(model, {State::slip_minus}));
  CHECK_FALSE(model::slip_growth(model, {State::stick}));
  CHECK_FALSE(model::slip_growth(model, {State::open}));
  CHECK_FALSE(model::slip_growth(block(a, b, c, 0.0, 0.0), {State::closed}));
  // C = c / m M shifts all exponents by c / 2m but for its square: half of the growth, and more than all.
  const double shift = 0.5 * found->rate;
  const auto damped = model::slip_growth(block(a, b, c, f, 4.0 * shift), {State::slip_plus});
  REQUIRE(damped);
  CHECK(damped->rate == doctest::Approx(found->rate - shift).epsilon(2e-2));
  CHECK_FALSE(model::slip_growth(block(a, b, c, f, 9.0 * shift), {State::slip_plus}));
}

TEST_CASE("a body that is free along its slip drifts, and neither flutters nor runs away") {
  // Turned to its slip K_slip = [[0, -s f kn], [0, b + kn]]: lambda = 0 twice, with one shape, which rounding parts.
  for (const double degrees : {0.0, 7.0, 23.0, 31.0, 48.0, 66.0})
    for (const double f : {0.1, 0.4, 0.73})
      for (const State state : {State::slip_plus, State::slip_minus}) {
        CAPTURE(degrees);
        CAPTURE(f);
        const double c = std::cos(degrees * M_PI / 180.0), s = std::sin(degrees * M_PI / 180.0), b = 20.0;
        const Model model =
            build_model(parse_scene(fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
[run]
t_end = 1.0
[matrices]
mass = [[2.0, 0.0], [0.0, 2.0]]
stiffness = [[{}, {}], [{}, {}]]
[[contacts]]
name = "pad"
law = "compliant"
normal = {{ d0 = {}, d1 = {} }}
tangent = {{ d0 = {}, d1 = {} }}
normal_stiffness = 1000.0
tangential_stiffness = 1000.0
friction = {}
)",
                                                b * s * s, b * s * c, b * s * c, b * c * c, s, c, c, -s, f),
                                    "test.toml"));
        CHECK_FALSE(model::slip_growth(model, {state}));
      }
}

TEST_CASE("one that runs away: the determinant of the stiffness has changed its sign") {
  // K_slip = [[a, c - s f kn (tangent)], ...]: with t = (1, x) the normal stiffness falls to kn (1 - s f x).
  const double a = 100.0, b = 50.0, kn = 1000.0;
  const auto found = model::slip_growth(block(a, b, 0.0, 0.5, 0.0, 3.0), {State::slip_plus});
  REQUIRE(found);
  CHECK(found->omega == 0.0);
  CHECK(found->rate == doctest::Approx(std::sqrt((0.5 * kn - b) / 2.0)).epsilon(1e-9));
}

TEST_SUITE_END();

}  // namespace signorini::tests::slip_growth_tests
