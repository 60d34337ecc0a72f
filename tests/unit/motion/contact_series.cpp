#include "motion/contact_series.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "unit/motion/lively_row.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/motion/contact_series");

TEST_CASE("a polynomial about another place has the same values") {
  const double given[] = {0.3, -1.7, 0.45, 2.0, -0.8, 0.11};
  double about[6];
  std::copy(std::begin(given), std::end(given), about);
  motion::shift(about, 5, 0.37);
  for (const double x : {-0.4, 0.0, 0.37, 0.9})
    CHECK(motion::value_at(about, 5, x - 0.37) ==
          doctest::Approx(motion::value_at(given, 5, x)).epsilon(1e-14));
  CHECK(about[5] == given[5]);
  CHECK(about[1] == doctest::Approx(-1.7 + 2 * 0.45 * 0.37 + 3 * 2.0 * 0.1369 - 4 * 0.8 * 0.050653 +
                                    5 * 0.11 * 0.01874161));
}

TEST_CASE("polynomials of a contact with an origin of their own") {
  motion::ContactSeries series;
  series.reset(3);
  const double N[] = {2.0, -3.0, 0.5, 4.0};
  std::copy(std::begin(N), std::end(N), series.mutable_coefficients(motion::ContactSeries::N));
  CHECK(std::isinf(series.rate(motion::ContactSeries::N)));
  series.set_origin(0.25);
  series.bound_rates(0.5);
  // 3 + 2 0.5 x + 3 4 x^2 at x = 0.5
  CHECK(series.rate(motion::ContactSeries::N) == doctest::Approx(3.0 + 0.5 + 3.0));
  CHECK(series.value(motion::ContactSeries::N, 0.25) == 2.0);
  CHECK(series.value(motion::ContactSeries::N, 0.75) == doctest::Approx(2.0 - 1.5 + 0.125 + 0.5));
  CHECK(series.integral(motion::ContactSeries::N, 0.25) == 0.0);
  CHECK(series.integral(motion::ContactSeries::N, 0.75) ==
        doctest::Approx(2.0 * 0.5 - 1.5 * 0.25 + 0.5 / 3.0 * 0.125 + 0.0625));
}

TEST_CASE("rates are those of g and ut, in whichever order they are asked for, and anew after each filling") {
  const Model m = lively_row(40);
  const linear::SystemMatrices structure(m);
  motion::StateSystems systems(m, structure);
  const motion::StateSystemPtr system = systems.system_of(rubbing_mode(m, 500));
  REQUIRE(system);
  motion::Series series;
  motion::ContactSeries seen;
  for (const double t : {0.0, 0.3}) {
    motion::Taylor(systems).expand(system, motion::Forcing(m, t, motion::Side::after), t, m.u0, m.v0, 8, 0.02,
                                   series);
    for (std::size_t c = 0; c < m.contacts.size(); c += 3) {
      CAPTURE(c);
      seen.fill(m.contacts[c], c, series, 8);
      // From the rates of degrees of freedom themselves: (k + 1)/s u_(k+1).
      const auto along = [&](const Combination& form, std::size_t k) {
        return form.dot(series.u.col(static_cast<Eigen::Index>(k)).data());
      };
      const double* at = seen.coefficients(motion::ContactSeries::an);
      const double* vt = seen.coefficients(motion::ContactSeries::vt);
      const double* vn = seen.coefficients(motion::ContactSeries::vn);
      for (std::size_t k = 0; k <= 8; ++k) {
        const double rate = static_cast<double>(k + 1) / 0.02;
        const double surface = series.forcing.surface[c * series.forcing.count + k + 1];
        CHECK(vn[k] == doctest::Approx(rate * along(m.contacts[c].normal, k + 1)));
        CHECK(vt[k] == doctest::Approx(rate * (along(m.contacts[c].tangent, k + 1) - surface)));
        CHECK(at[k] ==
              doctest::Approx(rate * static_cast<double>(k + 2) / 0.02 * along(m.contacts[c].normal, k + 2)));
        CHECK(seen.coefficients(motion::ContactSeries::applied_normal_force_rate)[k] == 0.0);
        CHECK(seen.coefficients(motion::ContactSeries::slide)[k] ==
              seen.coefficients(motion::ContactSeries::ut)[k]);
      }
    }
  }
}

TEST_SUITE_END();
