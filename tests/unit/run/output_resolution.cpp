// Peaks of p(x, t) along a stretch in a part of a step, where both places are known.
#include "run/output_resolution.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

namespace signorini::tests::stretch_peaks {
namespace {

using Field = std::function<double(double, double)>;

std::vector<run::Chebyshev::Values> sampled(std::size_t points, const Field& p) {
  std::vector<run::Chebyshev::Values> f(points);
  for (std::size_t i = 0; i < points; ++i)
    for (std::size_t j = 0; j < run::Chebyshev::count; ++j)
      f[i][j] = p(base::PolynomialInterpolation::point(points, i), run::Chebyshev::nodes()[j]);
  return f;
}

}  // namespace

TEST_SUITE_BEGIN("unit/run/output_resolution");

TEST_CASE("a hill whose top wanders along the stretch: the time of its highest place") {
  // highest where t = 0.37, at x = 0.4 + 0.1 sin 0.37: at no point
  const Field hill = [](double x, double t) {
    const double off = x - 0.4 - 0.1 * std::sin(t);
    return 5.0 - 3.0 * off * off - (t - 0.37) * (t - 0.37);
  };
  for (const double sign : {1.0, -1.0}) {
    const auto f = sampled(6, [&](double x, double t) { return sign * hill(x, t); });
    const std::vector<double> peaks = run::peaks_along(f, 1, sign, sign * 4.9);
    REQUIRE(peaks.size() == 1);
    CHECK(std::abs(peaks[0] - 0.37) < 1e-9);
    const base::PolynomialInterpolation::Extremes e =
        base::PolynomialInterpolation::extremes(run::values_along(f, 1, peaks[0]), 6);
    CHECK(std::abs((sign > 0.0 ? e.greatest : -e.least) - 5.0) < 1e-13);
    CHECK(std::abs((sign > 0.0 ? e.at_greatest : e.at_least) - 0.4 - 0.1 * std::sin(0.37)) < 1e-7);
    CHECK(run::peaks_along(f, 1, sign, sign * 6.0).empty());  // nothing that high is there
  }
}

TEST_CASE("the greatest of two branches that cross has a valley there, and peaks beside it") {
  // at x = 0 it peaks at t = -0.6, at x = 1 at 0.5; between them a line
  const Field two = [](double x, double t) {
    const double a = std::cos(t + 0.6), b = 0.9 * std::cos(t - 0.5);
    return (1.0 - x) * a + x * b;
  };
  const auto f = sampled(3, two);
  const std::vector<double> peaks = run::peaks_along(f, 1, 1.0, 0.0);
  REQUIRE(peaks.size() == 2);
  CHECK(std::abs(peaks[0] + 0.6) < 1e-9);
  CHECK(std::abs(peaks[1] - 0.5) < 1e-9);
}

TEST_CASE("bounds along a stretch hold everything on it, and of one point they are its own") {
  const Field wave = [](double x, double t) { return std::sin(2.0 * t + 3.0 * x) + 0.2 * x * x * x * t; };
  for (const std::size_t points : {std::size_t(3), std::size_t(5), std::size_t(6)}) {
    const auto f = sampled(points, wave);
    const run::ValueBounds b = run::bounds_along(f, 1, true);
    for (int i = 0; i <= 40; ++i)
      for (int j = 0; j <= 40; ++j) {
        const double p = base::PolynomialInterpolation::interpolate(run::values_along(f, 1, j / 20.0 - 1.0),
                                                                    points, i / 40.0);
        CHECK(p <= b.greatest + 1e-12);
        CHECK(p >= b.least - 1e-12);
      }
  }
  const auto one = sampled(1, [](double, double t) { return t * t; });
  const run::ValueBounds b = run::bounds_along(one, 4, false);
  CHECK(b.least == 0.0);
  CHECK(b.greatest == 1.0);
}

TEST_SUITE_END();

}  // namespace signorini::tests::stretch_peaks
