#include "linear/band_factors.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>

using namespace signorini;

namespace {

/// Symmetric and dominant on the diagonal but for a part that is neither, in the units of `scale`.
Eigen::MatrixXd banded(Eigen::Index n, Eigen::Index width, double skew, double scale) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  const auto unit = [&](Eigen::Index i) { return std::pow(scale, static_cast<double>(i % 3)); };
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = std::max<Eigen::Index>(0, i - width); j < std::min(n, i + width + 1); ++j) {
      const double both =
          i == j ? 2.7 * static_cast<double>(width) + 0.3
                 : std::cos(static_cast<double>(i + j) * static_cast<double>(1 + std::abs(i - j)));
      const double one = i < j ? skew * std::sin(static_cast<double>(3 * i + j)) : 0.0;
      a(i, j) = unit(i) * unit(j) * (both + one);
    }
  return a;
}

/// Rows [begin, end) of a.
void fill(const Eigen::MatrixXd& a, Eigen::Index width, Eigen::Index begin, Eigen::Index end,
          linear::BandFactors& band) {
  band.clear(static_cast<std::size_t>(begin), static_cast<std::size_t>(end));
  for (Eigen::Index i = begin; i < end; ++i)
    for (Eigen::Index j = std::max<Eigen::Index>(0, i - width); j < std::min(a.rows(), i + width + 1); ++j)
      band.row(static_cast<std::size_t>(i))[width + j - i] = a(i, j);
}

bool factor(const Eigen::MatrixXd& a, Eigen::Index width, linear::BandFactors& band) {
  fill(a, width, 0, a.rows(), band);
  return band.factor();
}

linear::BandFactors room(const Eigen::MatrixXd& a, Eigen::Index width) {
  return {static_cast<std::size_t>(a.rows()), static_cast<std::size_t>(width)};
}

}  // namespace

TEST_SUITE_BEGIN("unit/linear/band_factors");

TEST_CASE("solutions are those of the dense matrix, whatever the width, in any units") {
  for (const Eigen::Index n : {1, 2, 7, 61})
    for (const Eigen::Index width : {0, 1, 2, 3, 4, 5, 7, 11})
      for (const double scale : {1.0, 1e3, 1e-4}) {
        CAPTURE(n);
        CAPTURE(width);
        CAPTURE(scale);
        const Eigen::MatrixXd a = banded(n, width, 0.6, scale);
        linear::BandFactors band = room(a, width);
        for (int again = 0; again < 2; ++again) REQUIRE(factor(a, width, band));
        const Eigen::VectorXd expected = Eigen::VectorXd::LinSpaced(n, 1.0, -2.3);
        // In the units of each unknown: what they make of the matrix is no part of the solution.
        Eigen::VectorXd x = expected;
        for (Eigen::Index i = 0; i < n; ++i) x[i] /= std::pow(scale, static_cast<double>(i % 3));
        const Eigen::VectorXd by_unit = x;
        x = (a * x).eval();
        band.solve(x.data());
        for (Eigen::Index i = 0; i < n; ++i)
          CHECK(std::abs(x[i] - by_unit[i]) < 1e-12 * std::pow(scale, -static_cast<double>(i % 3)));
      }
}

TEST_CASE("a matrix that needs exchanges of rows, or is singular, has no factors, in any units") {
  for (const double scale : {1.0, 0x1p17, 0x1p-23}) {
    CAPTURE(scale);
    const Eigen::Vector3d units(1.0, scale, 1.0 / scale);
    const auto factors = [&](const Eigen::Matrix3d& a) {
      const Eigen::MatrixXd scaled = units.asDiagonal() * a * units.asDiagonal();
      linear::BandFactors band = room(scaled, 1);
      return factor(scaled, 1, band);
    };
    Eigen::Matrix3d a;
    a << 2, 1, 0, 1, 2, 1, 0, 1, 2;
    CHECK(factors(a));
    a(0, 0) = 0.0;  // regular, and no pivot
    CHECK_FALSE(factors(a));
    a(0, 0) = 1e-6;  // regular; five digits would go
    CHECK_FALSE(factors(a));
    a(0, 0) = std::nan("");
    CHECK_FALSE(factors(a));
    a << 1, 1, 0, 1, 2, 1, 0, 1, 1;  // the sum of rows with signs + - + is zero
    CHECK_FALSE(factors(a));
  }
}

TEST_CASE("factors of some rows go on from those before, to the last bit") {
  const Eigen::Index n = 97;
  for (const Eigen::Index width : {1, 3, 5, 8, 9})
    for (const Eigen::Index first : {0, 1, 40, 90}) {
      CAPTURE(width);
      CAPTURE(first);
      Eigen::MatrixXd a = banded(n, width, 0.6, 1.0);
      linear::BandFactors band = room(a, width), whole = room(a, width);
      REQUIRE(factor(a, width, band));
      a(first, first) *= 1.7;
      if (first > 0) a(first, first - 1) += 0.3;
      REQUIRE(factor(a, width, whole));
      for (Eigen::Index begin = first; begin < n; begin += 20) {
        const Eigen::Index end = std::min(n, begin + 20);
        fill(a, width, begin, end, band);
        REQUIRE(band.factor(static_cast<std::size_t>(begin), static_cast<std::size_t>(end)));
      }
      Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, 1.0, -2.3), y = x;
      band.solve(x.data());
      whole.solve(y.data());
      CHECK(x == y);
    }
}

TEST_SUITE_END();
