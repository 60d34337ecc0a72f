#include "engine/events/first_root.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "engine/events/step_history.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/engine/events/bernstein");

TEST_CASE("power and Bernstein form agree in value and integral") {
  const std::array<double, 6> a{0.3, -2.0, 1.5, 4.0, -3.0, 0.7};
  for (int degree = 0; degree <= 5; ++degree) {
    const events::Bernstein p = events::Bernstein::from_powers(degree, a);
    for (double x : {0.0, 0.1, 0.5, 0.73, 1.0}) {
      double value = 0.0, integral = 0.0;
      for (int j = degree; j >= 0; --j) {
        value = value * x + a[static_cast<std::size_t>(j)];
        integral += a[static_cast<std::size_t>(j)] * std::pow(x, j + 1) / (j + 1);
      }
      CHECK(p.value(x) == doctest::Approx(value).epsilon(1e-14));
      CHECK(p.integral(x) == doctest::Approx(integral).epsilon(1e-14));
    }
  }
}

TEST_CASE("two crossings inside the interval are found although both ends are positive") {
  // (x - 0.4)(x - 0.4001): below zero for a ten-thousandth of the step
  const events::Bernstein p = events::Bernstein::from_powers(2, {0.4 * 0.4001, -0.8001, 1.0});
  CHECK(p.value(0.0) > 0.0);
  CHECK(p.value(1.0) > 0.0);
  const auto x = events::first_root(p, 1e-13);
  REQUIRE(x);
  CHECK(*x == doctest::Approx(0.4).epsilon(1e-9));
}

TEST_CASE("a polynomial that only comes close is proved positive") {
  const events::Bernstein p =
      events::Bernstein::from_powers(2, {0.16 + 1e-9, -0.8, 1.0});  // (x - 0.4)^2 + 1e-9
  CHECK_FALSE(events::first_root(p, 1e-13));
}

TEST_CASE("random quintics: the first fall is where sampling sees the first sign change") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> root(-0.5, 1.5);
  for (int trial = 0; trial < 500; ++trial) {
    // product of five linear factors, signed to be positive at 0
    std::array<double, 6> a{1.0};
    double first = 2.0, at_zero = 1.0;
    for (int i = 0; i < 5; ++i) {
      const double r = root(random);
      for (int j = i + 1; j > 0; --j)
        a[static_cast<std::size_t>(j)] =
            a[static_cast<std::size_t>(j - 1)] - r * a[static_cast<std::size_t>(j)];
      a[0] *= -r;
      at_zero *= -r;
      if (r > 0.0) first = std::min(first, r);
    }
    if (at_zero < 0.0)
      for (double& c : a) c = -c;
    const auto x = events::first_root(events::Bernstein::from_powers(5, a), 1e-13);
    if (first <= 1.0) {
      REQUIRE(x);
      CHECK(*x == doctest::Approx(first).epsilon(1e-6));
    } else {
      CHECK_FALSE(x);
    }
  }
}

TEST_CASE("the polynomial through unequal steps is exact for its degree") {
  const auto f = [](double t) { return 1.0 + t - 2.0 * t * t + 0.5 * std::pow(t, 5); };
  events::StepHistory history(1);
  *history.restart(0.0) = f(0.0);
  double t = 0.0;
  for (double h : {0.1, 0.13, 0.2, 0.2, 0.31, 0.4}) {
    t += h;
    *history.push(t) = f(t);
  }
  history.prepare(5);
  const events::Bernstein p = history.polynomial(0);
  CHECK(p.value(0.25) == doctest::Approx(f(history.begin() + 0.25 * 0.4)).epsilon(1e-12));
  CHECK(history.end() == doctest::Approx(t));
  CHECK(history.integral(0) == doctest::Approx(0.4 * p.integral(1.0)).epsilon(1e-13));
}

TEST_CASE("weights that are kept while steps are equal change with the steps") {
  const auto f = [](double t) { return std::pow(t - 0.7, 3); };
  events::StepHistory history(1);
  *history.restart(0.0) = f(0.0);
  double t = 0.0;
  for (double h : {0.1, 0.1, 0.1, 0.1, 0.1, 0.05, 0.05, 0.05, 0.05, 0.05}) {
    t += h;
    *history.push(t, h) = f(t);
    history.prepare(3);
    if (t < 0.35) continue;  // fewer than four values
    const events::Bernstein p = history.polynomial(0);
    CHECK(p.value(0.4) == doctest::Approx(f(t - 0.6 * h)).epsilon(1e-11));
    CHECK(history.integral(0) == doctest::Approx((std::pow(t - 0.7, 4) - std::pow(t - h - 0.7, 4)) / 4.0));
  }
}

TEST_CASE("a quick proof is never wrong, and holds where little changes") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int proofs = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    events::StepHistory history(1);
    double t = 0.0;
    const double spread = std::pow(10.0, -4.0 * uniform(random));
    *history.restart(t) = 1.0;
    for (int i = 0; i < 6; ++i) {
      const double h = 0.1 + 0.2 * uniform(random);
      t += h;
      *history.push(t, h) = 1.0 + spread * (2.0 * uniform(random) - 1.0);
    }
    history.prepare(5);
    if (!history.clearly_positive(0)) continue;
    ++proofs;
    const events::Bernstein p = history.polynomial(0);
    for (int i = 0; i <= 50; ++i) CHECK(p.value(i / 50.0) > 0.0);
  }
  CHECK(proofs > 500);
  CHECK(proofs < 2000);
}

TEST_CASE("what is told to go one way does, on lines that are bent more and less, up and down") {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int proofs = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    events::StepHistory history(1);
    double t = 0.0;
    const double bent = std::pow(10.0, -5.0 * uniform(random)), slope = trial % 2 == 0 ? 1.0 : -1.0;
    const int degree = 1 + trial % 5;
    *history.restart(t) = 3.0;
    for (int i = 0; i < 6; ++i) {
      const double h = 0.1 + 0.2 * uniform(random);
      t += h;
      *history.push(t, h) = 3.0 + slope * t + bent * (2.0 * uniform(random) - 1.0);
    }
    history.prepare(degree);
    if (!history.clearly_monotone(0)) continue;
    ++proofs;
    const events::Bernstein p = history.polynomial(0);
    const double way = p.value(1.0) > p.value(0.0) ? 1.0 : -1.0;
    for (int i = 0; i < 50; ++i) CHECK(way * (p.value((i + 1) / 50.0) - p.value(i / 50.0)) > -1e-13);
  }
  CHECK(proofs > 500);
  CHECK(proofs < 2000);
}

TEST_SUITE_END();
