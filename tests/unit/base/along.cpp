// Extremes of polynomials whose turning points are known.
#include "base/curves.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

namespace signorini::tests::along {
namespace {

base::PolynomialInterpolation::Values at_points_of(std::size_t n, const std::function<double(double)>& p) {
  base::PolynomialInterpolation::Values f{};
  for (std::size_t i = 0; i < n; ++i) f[i] = p(base::PolynomialInterpolation::point(n, i));
  return f;
}

}  // namespace

TEST_SUITE_BEGIN("unit/base/along");

TEST_CASE("points ascend from 0 to 1, and the polynomial goes through its values everywhere") {
  for (std::size_t n = 2; n <= base::PolynomialInterpolation::max_points; ++n) {
    CAPTURE(n);
    CHECK(base::PolynomialInterpolation::point(n, 0) == 0.0);
    CHECK(base::PolynomialInterpolation::point(n, n - 1) == 1.0);
    for (std::size_t i = 1; i < n; ++i)
      CHECK(base::PolynomialInterpolation::point(n, i) > base::PolynomialInterpolation::point(n, i - 1));
    const auto p = [&](double x) { return 3.0 - 2.0 * x + std::pow(x, static_cast<double>(n - 1)); };
    const base::PolynomialInterpolation::Values f = at_points_of(n, p);
    for (const double x : {0.0, 0.13, 0.5, 0.77, 1.0})
      CHECK(base::PolynomialInterpolation::interpolate(f, n, x) == doctest::Approx(p(x)).epsilon(1e-14));
  }
}

TEST_CASE("a parabola, a cubic with both turns inside, a quintic with four") {
  const auto parabola = at_points_of(3, [](double x) { return 7.0 * x * (1.0 - x) - 0.5; });
  base::PolynomialInterpolation::Extremes e = base::PolynomialInterpolation::extremes(parabola, 3);
  CHECK(e.greatest == doctest::Approx(1.25).epsilon(1e-14));
  CHECK(e.at_greatest == doctest::Approx(0.5).epsilon(1e-12));
  CHECK(e.least == doctest::Approx(-0.5).epsilon(1e-14));
  CHECK(e.at_least == 0.0);
  // p' = (x - 0.2)(x - 0.7)
  const auto cubic = [](double x) { return x * x * x / 3.0 - 0.45 * x * x + 0.14 * x; };
  e = base::PolynomialInterpolation::extremes(at_points_of(6, cubic), 6);
  CHECK(e.at_least == doctest::Approx(0.7).epsilon(1e-9));
  CHECK(e.least == doctest::Approx(cubic(0.7)).epsilon(1e-12));
  CHECK(e.at_greatest == 1.0);
  CHECK(e.greatest == doctest::Approx(cubic(1.0)).epsilon(1e-14));
  // Chebyshev's T5(2x - 1): +-1 at four places inside, and at the ends
  const auto chebyshev = [](double x) { return std::cos(5.0 * std::acos(2.0 * x - 1.0)); };
  e = base::PolynomialInterpolation::extremes(at_points_of(6, chebyshev), 6);
  CHECK(e.greatest == doctest::Approx(1.0).epsilon(1e-13));
  CHECK(e.least == doctest::Approx(-1.0).epsilon(1e-13));
  CHECK(e.at_least == 0.0);
  CHECK(e.at_greatest == doctest::Approx(0.5 * (1.0 - std::cos(M_PI / 5.0))).epsilon(1e-7));
}

TEST_CASE("two turns close together, a constant, and one point") {
  // p' = (x - 0.41)(x - 0.42): no value at a point tells
  const auto p = [](double x) { return x * x * x / 3.0 - 0.415 * x * x + 0.1722 * x; };
  const base::PolynomialInterpolation::Extremes e =
      base::PolynomialInterpolation::extremes(at_points_of(5, p), 5);
  CHECK(e.greatest == doctest::Approx(p(1.0)).epsilon(1e-14));
  CHECK(e.at_least == 0.0);
  base::PolynomialInterpolation::Values f{};
  f.fill(-4.0);
  const base::PolynomialInterpolation::Extremes flat = base::PolynomialInterpolation::extremes(f, 6);
  CHECK(flat.greatest == -4.0);
  CHECK(flat.at_greatest == 0.0);
  CHECK(flat.at_least == 0.0);
  const base::PolynomialInterpolation::Extremes one = base::PolynomialInterpolation::extremes(f, 1);
  CHECK(one.least == -4.0);
  CHECK(one.greatest == -4.0);
}

TEST_SUITE_END();

}  // namespace signorini::tests::along
