#include "engine/events/first_root.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

using namespace signorini;

namespace {

/// Product of (x - r) over the roots, times `factor`, ascending coefficients.
std::vector<double> from_roots(const std::vector<double>& roots, double factor) {
  std::vector<double> a{factor};
  for (const double r : roots) {
    a.push_back(0.0);
    for (std::size_t k = a.size() - 1; k > 0; --k) a[k] = a[k - 1] - r * a[k];
    a[0] *= -r;
  }
  return a;
}

double value(const std::vector<double>& a, double x) {
  double sum = 0.0;
  for (std::size_t k = a.size(); k-- > 0;) sum = sum * x + a[k];
  return sum;
}

double slack_of(const std::vector<double>& a) {
  double sum = 0.0;
  for (const double c : a) sum += std::abs(c);
  return 1e-15 * sum;
}

events::FirstRoot fall(const std::vector<double>& a) {
  return events::first_root(a.data(), a.size() - 1, slack_of(a));
}

}  // namespace

TEST_SUITE_BEGIN("unit/engine/events/first_root");

TEST_CASE("what is not a number is said to be so, not halved for ever") {
  const double nan = std::nan(""), inf = HUGE_VAL;
  CHECK(fall({nan, 1.0, -3.0}).kind == events::FirstRoot::Kind::not_finite);
  CHECK(fall({1.0, nan, -3.0}).kind == events::FirstRoot::Kind::not_finite);
  CHECK(fall({1.0, -inf, inf}).kind == events::FirstRoot::Kind::not_finite);
  const double a[] = {1.0, -3.0};
  CHECK(events::first_root(a, 1, inf).kind == events::FirstRoot::Kind::not_finite);
}

TEST_CASE("simple falls, rises and none") {
  CHECK(fall({1.0, -2.0}).kind == events::FirstRoot::Kind::crossing);
  CHECK(fall({1.0, -2.0}).x == doctest::Approx(0.5).epsilon(1e-15));
  CHECK(fall({1.0, -0.5}).kind == events::FirstRoot::Kind::none);
  CHECK(fall({0.0, 1.0}).kind == events::FirstRoot::Kind::none);       // starts at zero and rises
  CHECK(fall({0.0, -1.0}).kind == events::FirstRoot::Kind::crossing);  // starts at zero and falls
  CHECK(fall({0.0, -1.0}).x == 0.0);
}

TEST_CASE("two crossings as close as 1e-7 of the interval are seen; a double root is a touch") {
  for (double gap : {1e-1, 1e-3, 1e-5, 1e-7}) {
    CAPTURE(gap);
    const events::FirstRoot f = fall(from_roots({0.37, 0.37 + gap}, 1.0));
    CHECK(f.kind == events::FirstRoot::Kind::crossing);
    CHECK(std::abs(f.x - 0.37) < 1e-14 / gap);  // conditioning: rounding of the coefficients over the slope
  }
  CHECK(fall(from_roots({0.5, 0.5}, 1.0)).kind == events::FirstRoot::Kind::touch);
  CHECK(std::abs(fall(from_roots({0.5, 0.5}, 1.0)).x - 0.5) < 1e-6);
  // Clear of zero by more than the slack: not even a touch.
  std::vector<double> above = from_roots({0.5, 0.5}, 1.0);
  above[0] += 1e-13;
  CHECK(fall(above).kind == events::FirstRoot::Kind::none);
  above[0] -= 2e-13;
  CHECK(fall(above).kind == events::FirstRoot::Kind::crossing);
}

TEST_CASE("oscillations over a step: 1 + depth - cos-like wiggles touch or cross at their troughs") {
  // p(x) = 1 + e + cos(10 x) as a Taylor polynomial: lowest at x = pi/10, by e above zero
  for (double e : {1e-2, 1e-6, 1e-10}) {
    for (double sign : {1.0, -1.0}) {
      CAPTURE(e);
      CAPTURE(sign);
      std::vector<double> a(33, 0.0);
      double c = 1.0;
      for (std::size_t k = 0; k < a.size(); ++k) {
        if (k % 2 == 0) a[k] = k % 4 == 0 ? c : -c;
        c *= 3.4 / static_cast<double>(k + 1);
      }
      a[0] += 1.0 + sign * e;
      const events::FirstRoot f = fall(a);
      CHECK(f.kind == (sign > 0.0 ? events::FirstRoot::Kind::none : events::FirstRoot::Kind::crossing));
      if (sign < 0.0)
        CHECK(f.x == doctest::Approx((std::acos(-1.0) - std::sqrt(2.0 * e)) / 3.4).epsilon(1e-3));
    }
  }
}

TEST_CASE("what stays above everywhere is passed as it is, not halved until it is monotone") {
  // 2 + T_6(2x - 1): six turns, never below 1
  std::vector<double> now{1.0}, next{-1.0, 2.0};
  for (int i = 1; i < 6; ++i) {
    std::vector<double> after(next.size() + 1, 0.0);
    for (std::size_t k = 0; k < next.size(); ++k) {
      after[k] -= 2.0 * next[k];
      after[k + 1] += 4.0 * next[k];
    }
    for (std::size_t k = 0; k < now.size(); ++k) after[k] -= now[k];
    now = std::exchange(next, after);
  }
  next[0] += 2.0;
  const events::FirstRoot none = fall(next);
  CHECK(none.kind == events::FirstRoot::Kind::none);
  CHECK(none.intervals > 1);
  CHECK(none.intervals <= 15);  // halves, quarters, eighths: in an eighth all its coefficients are above zero
}

TEST_CASE("random polynomials: no sample before the reported fall is negative, and it is a root") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-0.3, 1.3), factor(0.1, 10.0);
  std::uniform_int_distribution<int> count(1, 9), times(1, 3);
  int falls = 0, clear = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    CAPTURE(trial);
    std::vector<double> roots;
    for (int i = count(random); i > 0; --i) {
      const double r = place(random);
      for (int j = times(random); j > 0; --j) roots.push_back(r);
    }
    std::vector<double> a = from_roots(roots, factor(random));
    if (a[0] < 0.0)
      for (double& c : a) c = -c;
    const double slack = slack_of(a);
    const events::FirstRoot f = events::first_root(a.data(), a.size() - 1, slack);
    const double until = f.kind == events::FirstRoot::Kind::crossing ? f.x : 1.0;
    double least = a[0];
    for (int i = 0; i <= 400; ++i) least = std::min(least, value(a, until * i / 400.0));
    REQUIRE(least >= -2.0 * slack);
    if (f.kind == events::FirstRoot::Kind::crossing) {
      ++falls;
      double after = value(a, f.x);
      for (int i = 1; i <= 200; ++i) after = std::min(after, value(a, std::min(1.0, f.x + 1e-3 * i)));
      REQUIRE(after < slack);
      REQUIRE(std::abs(value(a, f.x)) < 1e3 * slack);
    } else {
      ++clear;
    }
  }
  CHECK(falls > 3000);
  CHECK(clear > 3000);
}

TEST_SUITE_END();
