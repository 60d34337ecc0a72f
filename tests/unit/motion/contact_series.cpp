#include "motion/contact_series.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace signorini;

TEST_SUITE_BEGIN("unit/motion/contact_series");

TEST_CASE("a polynomial about another place has the same values") {
  const double given[] = {0.3, -1.7, 0.45, 2.0, -0.8, 0.11};
  double about[6];
  std::copy(std::begin(given), std::end(given), about);
  shift(about, 5, 0.37);
  for (const double x : {-0.4, 0.0, 0.37, 0.9})
    CHECK(value_at(about, 5, x - 0.37) == doctest::Approx(value_at(given, 5, x)).epsilon(1e-14));
  CHECK(about[5] == given[5]);
  CHECK(about[1] == doctest::Approx(-1.7 + 2 * 0.45 * 0.37 + 3 * 2.0 * 0.1369 - 4 * 0.8 * 0.050653 +
                                    5 * 0.11 * 0.01874161));
}

TEST_CASE("polynomials of a contact with an origin of their own") {
  ContactSeries series;
  series.reset(3);
  const double N[] = {2.0, -3.0, 0.5, 4.0};
  std::copy(std::begin(N), std::end(N), series.place(ContactSeries::N));
  CHECK(std::isinf(series.rate(ContactSeries::N)));
  series.set_origin(0.25);
  series.bound_rates(0.5);
  // 3 + 2 0.5 x + 3 4 x^2 at x = 0.5
  CHECK(series.rate(ContactSeries::N) == doctest::Approx(3.0 + 0.5 + 3.0));
  CHECK(series.value(ContactSeries::N, 0.25) == 2.0);
  CHECK(series.value(ContactSeries::N, 0.75) == doctest::Approx(2.0 - 1.5 + 0.125 + 0.5));
  CHECK(series.integral(ContactSeries::N, 0.25) == 0.0);
  CHECK(series.integral(ContactSeries::N, 0.75) ==
        doctest::Approx(2.0 * 0.5 - 1.5 * 0.25 + 0.5 / 3.0 * 0.125 + 0.0625));
}
