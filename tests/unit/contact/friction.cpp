#include "contact/friction.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace signorini;

namespace {

Contact stribeck() {
  Contact c;
  c.law = Law::slider;
  c.friction.static_ = 0.5;
  c.friction.kinetic = 0.2;
  c.friction.stribeck_velocity = 0.7;
  return c;
}

Contact rising() {
  Contact c = stribeck();
  c.friction = {0.2, 0.5, {}, 0.7};
  return c;
}

/// Coefficients of ut' of slip in direction s, and of N beside it.
std::vector<double> slip_rates(int s) { return {s * 0.4, s * -0.9, s * 0.35, s * 0.2, s * -0.1}; }
const std::vector<double> pressed{-12.0, 3.0, 1.5, -0.7, 0.2};

}  // namespace

TEST_SUITE_BEGIN("unit/contact/friction");

TEST_CASE("friction falls from static to kinetic with the slip rate, and only where a law says so") {
  Contact c = stribeck();
  CHECK(contact::sliding_friction(c, 0.0) == doctest::Approx(0.5));
  CHECK(contact::sliding_friction(c, 0.7) == doctest::Approx(0.2 + 0.3 / std::exp(1.0)));
  CHECK(contact::friction_varies(c));
  CHECK(contact::slips_nonlinearly(c, State::slip_minus));
  CHECK_FALSE(contact::slips_nonlinearly(c, State::stick));
  c.friction.stribeck_velocity.reset();
  CHECK(contact::sliding_friction(c, 3.0) == 0.2);
  CHECK(contact::sliding_friction_slope(c, 3.0) == 0.0);
  CHECK_FALSE(contact::slips_nonlinearly(c, State::slip_minus));
}

TEST_CASE("friction rises from slow to fast with the slip rate, from the limit of stick on") {
  const Contact c = rising();
  CHECK(contact::sliding_friction(c, 0.0) == contact::static_friction(c));
  CHECK(contact::sliding_friction(c, 0.7) == doctest::Approx(0.5 - 0.3 / std::exp(1.0)));
  CHECK(contact::sliding_friction(c, 70.0) == 0.5);
  CHECK(contact::sliding_friction_slope(c, 0.0) == doctest::Approx(0.3 / 0.7));
  CHECK(contact::kinetic_friction(c) == 0.2);
  CHECK(contact::friction_varies(c));
}

TEST_CASE("the tangent of the row of slip is its derivative, in both directions") {
  for (const Contact& c : {stribeck(), rising()})
    for (const int s : {1, -1}) {
      CAPTURE(s);
      ContactMotion m;
      m.N = -12.0;
      m.T = s * 3.0;
      m.vt = s * 0.4;
      const Form tangent = contact::sliding_row_tangent(c, s, m);
      const double h = 1e-6;
      for (double ContactMotion::*entry : {&ContactMotion::N, &ContactMotion::T, &ContactMotion::vt}) {
        ContactMotion less = m, more = m, unit;
        less.*entry -= h;
        more.*entry += h;
        unit.*entry = 1.0;
        const double slope =
            (contact::sliding_row_value(c, s, more) - contact::sliding_row_value(c, s, less)) / (2.0 * h);
        CHECK(tangent.rate(unit) == doctest::Approx(slope).epsilon(1e-8));
      }
    }
}

TEST_CASE("the series of T = -s f(s p') N has the coefficients of the product") {
  for (const Contact& c : {stribeck(), rising()})
    for (const int s : {1, -1}) {
      CAPTURE(s);
      const std::vector<double> rate = slip_rates(s);
      contact::FrictionRecursion friction;
      friction.begin(c, s, rate[0]);
      std::vector<double> T{-s * friction.first() * pressed[0]};
      for (std::size_t k = 1; k < rate.size(); ++k)
        T.push_back(-friction.next(rate[k], [&](std::size_t i) { return pressed[i]; }) -
                    s * friction.first() * pressed[k]);
      // Against the product itself near x = 0: the difference is of order x^5.
      const auto at = [](const std::vector<double>& a, double x) {
        double sum = 0.0;
        for (std::size_t k = a.size(); k-- > 0;) sum = sum * x + a[k];
        return sum;
      };
      double last = 0.0;
      for (const double x : {0.02, 0.01}) {
        const double error =
            std::abs(at(T, x) + s * contact::sliding_friction(c, s * at(rate, x)) * at(pressed, x));
        CHECK(error < 40.0 * std::pow(x, 5));
        if (last > 0.0) CHECK(last / error > 28.0);
        last = error;
      }
    }
}

TEST_CASE("where the rate is an unknown of its level the recursion takes it afterwards") {
  const Contact c = rising();
  const auto applied = [&](std::size_t i) { return pressed[i]; };
  for (const int s : {1, -1}) {
    const std::vector<double> rate = slip_rates(s);
    contact::FrictionRecursion before, after;
    before.begin(c, s, rate[0]);
    after.begin(c, s, rate[0]);
    ContactMotion m;
    m.N = pressed[0];
    m.vt = rate[0];
    const double slope = contact::sliding_row_tangent(c, s, m).vt;
    for (std::size_t k = 1; k < rate.size(); ++k) {
      if (k > 1) after.take_rate(rate[k - 1]);
      const double all = before.next(rate[k], applied), rest = after.without_rate(applied);
      CHECK(rest + slope * rate[k] == doctest::Approx(all).epsilon(1e-14));
    }
  }
}

TEST_CASE(
    "a series follows friction as far as its omitted terms are below rounding, also where it begins far from "
    "it") {
  // slip that slows down, x = x0 - a t, so E = exp(-x0/v + a t/v)
  constexpr double v = 0.7, a = 3.0;
  for (const double x0 : {0.0, 2.0, 9.0, 30.0, 700.0})  // E_0 from 1 to zero by underflow
    for (const double slowing : {a, -a})
      for (const std::size_t degree : {12, 30}) {
        CAPTURE(x0);
        CAPTURE(slowing);
        CAPTURE(degree);
        contact::FrictionRecursion friction;
        friction.begin(stribeck(), 1, x0);
        for (std::size_t k = 1; k <= degree; ++k)
          (void)friction.next(k == 1 ? -slowing : 0.0, [](std::size_t) { return 0.0; });
        // Terms after E_degree, by the rest of the exponential series.
        const auto rest = [&](double t) {
          const double z = std::abs(slowing) * t / v;
          double sum = 0.0, term = -x0 / v;  // logarithm
          for (std::size_t k = 1; k < 4000; ++k) {
            term += std::log(z / static_cast<double>(k));
            if (k > degree) sum += std::exp(term);
          }
          return sum;
        };
        const double whole = 1e3, reach = friction.reach(degree, whole);
        CHECK(reach < whole);
        CHECK(rest(reach) <= 0.25 * 2.3e-16);
        CHECK(rest(1.5 * reach) > 0.25 * 2.3e-16);  // not needlessly short
        CHECK(friction.reach(degree, 0.5 * reach) == 0.5 * reach);
      }
}

TEST_SUITE_END();
