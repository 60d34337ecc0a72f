#include "engine/events/step_history.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace signorini;

TEST_SUITE("unit/engine/events/step_history") {
  TEST_CASE("the straight line falls where the paper's interpolation says, in both directions of slip") {
    // t = t0 + dt (s T_U0 - T0)/((T1 - T0) - s (T_U1 - T_U0)) for the guard T_U - s T
    const double T_U0 = 3.0, T_U1 = 2.6;
    for (double s : {1.0, -1.0}) {
      const double T0 = 2.0 * s, T1 = 2.9 * s;
      const double paper = (s * T_U0 - T0) / ((T1 - T0) - s * (T_U1 - T_U0));
      const events::GuardCubic path{T_U0 - s * T0, T_U1 - s * T1};
      CHECK(path.linear_root() == doctest::Approx(paper).epsilon(1e-14));
      CHECK(paper > 0.0);
      CHECK(paper < 1.0);
    }
  }

  TEST_CASE("a cubic that falls does so at its root, with its slope") {
    // (a - x) (x^2 + b x + 1)
    for (double a : {1e-6, 0.13, 0.5, 0.97})
      for (double b : {-1.5, 0.0, 3.0}) {
        CAPTURE(a);
        CAPTURE(b);
        const auto q = [&](double x) { return x * x + b * x + 1.0; };
        const auto p = [&](double x) { return (a - x) * q(x); };
        const auto r = [&](double x) { return -q(x) + (a - x) * (2.0 * x + b); };
        const auto fall = events::GuardCubic{p(0.0), p(1.0), r(0.0), r(1.0)}.cubic_root();
        REQUIRE(fall);
        CHECK(std::abs(fall->x - a) < 1e-3);  // a guess
        CHECK(fall->slope == doctest::Approx(r(a)).epsilon(0.01));
      }
    CHECK_FALSE(events::GuardCubic{1.0, -1.0, std::nan(""), 0.0}.cubic_root());
  }

  TEST_CASE("a cubic that dips below zero between positive ends is seen, down to a touch") {
    // (x - a)^2 (x + 1) + e
    for (double a : {0.1, 0.5, 0.9})
      for (double e : {-1e-2, -1e-6, -1e-10, 1e-10, 1e-6}) {
        CAPTURE(a);
        CAPTURE(e);
        const auto p = [&](double x) { return (x - a) * (x - a) * (x + 1.0) + e; };
        const auto r = [&](double x) { return 2.0 * (x - a) * (x + 1.0) + (x - a) * (x - a); };
        if (!(p(0.0) > 0.0 && p(1.0) > 0.0)) continue;
        const auto dip = events::GuardCubic{p(0.0), p(1.0), r(0.0), r(1.0)}.interior_minimum();
        CHECK(dip.has_value() == (e < 0.0));
        if (dip) CHECK(*dip == doctest::Approx(a).epsilon(1e-9));
      }
  }

  TEST_CASE("a parabola, and a line that never falls") {
    const auto dip = events::GuardCubic{0.24, 0.24, -1.0, 1.0}.interior_minimum();  // (x - 1/2)^2 - 0.01
    REQUIRE(dip);
    CHECK(*dip == doctest::Approx(0.5));
    CHECK(!events::GuardCubic{1.0, 2.0, 1.0, 1.0}.interior_minimum());
    CHECK(!events::GuardCubic{2.0, 1.0, -1.0, -1.0}.interior_minimum());
  }

  TEST_CASE("rates from three values are those of the parabola through them") {
    const auto p = [](double t) { return 2.0 - 3.0 * t + 5.0 * t * t; };
    const double h = 0.3, h_before = 0.2;
    events::GuardCubic path{p(0.0), p(h)};
    events::rates_from_values(path, h, p(-h_before), h_before);
    CHECK(path.r0 == doctest::Approx(h * -3.0).epsilon(1e-12));
    CHECK(path.r1 == doctest::Approx(h * (-3.0 + 10.0 * h)).epsilon(1e-12));
    events::rates_from_values(path, h, 0.0, 0.0);
    CHECK(path.r0 == doctest::Approx(p(h) - p(0.0)));
  }
}
