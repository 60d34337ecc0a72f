// Friction whose coefficient depends on N: its limit along a series, beside that of the function itself.
#include "contact/friction.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "contact/law.hpp"

namespace signorini::tests {
namespace {

Friction bearing(double light, double heavy, double force) {
  Friction f{light, heavy};
  f.force = force;
  return f;
}

/// By the definition.
double limit(const Friction& f, double x) {
  const double share = std::exp(-x / *f.force);
  return x * (f.static_ * share + f.kinetic * (1.0 - share));
}

}  // namespace

TEST_SUITE_BEGIN("unit/contact/friction_limit");

TEST_CASE(
    "the limit is N times the coefficient, of light loads at first and of heavy ones at last; its slope is "
    "its own") {
  for (const Friction& f : {bearing(0.14, 0.05, 37.0), bearing(0.03, 0.2, 900.0)})
    for (const double x : {1e-9, 3.0, 37.0, 410.0, 9e4}) {
      CAPTURE(x);
      const double h = 1e-3 * x;
      CHECK(contact::friction_limit(f, x) == doctest::Approx(limit(f, x)).epsilon(1e-14));
      const double slope =
          (8.0 * (limit(f, x + h) - limit(f, x - h)) - (limit(f, x + 2.0 * h) - limit(f, x - 2.0 * h))) /
          (12.0 * h);
      CHECK(contact::friction_limit_slope(f, x) == doctest::Approx(slope).epsilon(1e-9));
    }
  const Friction f = bearing(0.14, 0.05, 37.0);
  CHECK(contact::friction_limit(f, -2.0) == -0.28);
  CHECK(contact::friction_limit_slope(f, -2.0) == 0.14);
  CHECK(contact::friction_limit_slope(f, 1e5) == doctest::Approx(0.05).epsilon(1e-12));
}

TEST_CASE("along a series the limit is that of the sum: what is left falls with the order") {
  const Friction f = bearing(0.14, 0.05, 37.0);
  constexpr std::array x = {52.0, -31.0, 14.0, 9.0, -23.0, 5.0};
  contact::LimitSeries series(f, x[0]);
  std::array<double, x.size()> F = {contact::friction_limit(f, x[0])};
  CHECK(series.slope() == doctest::Approx(contact::friction_limit_slope(f, x[0])).epsilon(1e-15));
  for (std::size_t k = 1; k < x.size(); ++k) {
    const double known = series.known();
    F[k] = series.take(x[k]);
    CHECK(F[k] == doctest::Approx(series.slope() * x[k] + known).epsilon(1e-15));
  }
  const auto left = [&](double t) {
    double load = 0.0, sum = 0.0;
    for (std::size_t k = x.size(); k-- > 0;) {
      load = load * t + x[k];
      sum = sum * t + F[k];
    }
    return std::abs(sum - limit(f, load));
  };
  CHECK(left(0.1) > 1e-12);
  CHECK(std::log2(left(0.1) / left(0.05)) == doctest::Approx(6.0).epsilon(0.05));
}

TEST_CASE(
    "rows, guards and slip rate of a contact whose friction depends on N vanish where its law says so") {
  Contact c;
  c.friction = bearing(0.14, 0.05, 37.0);
  c.normal_stiffness = 800.0;
  c.tangential_stiffness = 500.0;
  ContactMotion m;
  m.N = -61.0;
  m.vn = 0.2;
  m.vt = 0.7;
  m.T = limit(c.friction, 61.0);
  contact::set_limit(c, m);
  CHECK(contact::rows(c, {State::slip_plus, 0.0}).tangent.value(m) == doctest::Approx(0.0));
  CHECK(contact::rows(c, {State::slip_minus, 0.0}).tangent.value(m) == doctest::Approx(2.0 * m.T));
  const auto stick = contact::guards(c, {State::stick, 0.0});
  CHECK(stick[1].kind == Guard::slip_plus);
  CHECK(stick[1].form.value(m) == doctest::Approx(0.0));
  CHECK(stick[2].form.value(m) == doctest::Approx(2.0 * m.T));
  // T = F all the time: kt (ut' - p') = F'(|N|) |N|'
  const double h = 1e-6,
               rate = (limit(c.friction, 61.0 - 160.0 * h) - limit(c.friction, 61.0 + 160.0 * h)) / (2.0 * h);
  CHECK(contact::slip_rate(c, 1).value(m) == doctest::Approx(0.7 - rate / 500.0).epsilon(1e-8));
  CHECK(contact::guards(c, {State::slip_plus, 0.0})[1].form == contact::slip_rate(c, 1));
}

TEST_SUITE_END();

}  // namespace signorini::tests
