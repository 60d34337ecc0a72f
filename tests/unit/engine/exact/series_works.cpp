#include "engine/exact/series_works.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace signorini;

namespace {

double mean(const exact::GaussRule& rule, double turn, double phase) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rule.count; ++i) {
    const double v = std::cos(turn * rule.x[i] + phase);
    sum += rule.w[i] * v * v;
  }
  return sum;
}

}  // namespace

TEST_SUITE_BEGIN("unit/engine/exact/series_works");

TEST_CASE("the power of a motion: the short rule to rounding up to its turn, the long one further") {
  const auto exact = [](double turn, double phase) {
    return 0.5 + (std::sin(2.0 * (turn + phase)) - std::sin(2.0 * phase)) / (4.0 * turn);
  };
  CHECK(exact::short_gauss_rule().count == 6);
  for (const double phase : {0.0, 0.4, 1.3, 2.9}) {
    CHECK(std::abs(mean(exact::short_gauss_rule(), exact::short_angle, phase) -
                   exact(exact::short_angle, phase)) < 1e-15);
    CHECK(std::abs(mean(exact::gauss_rule(), 2.5, phase) - exact(2.5, phase)) < 1e-15);
  }
  CHECK(std::abs(mean(exact::short_gauss_rule(), 2.5, 0.4) - exact(2.5, 0.4)) > 1e-10);
}

TEST_CASE("both are exact for polynomials of degree 2 count - 1") {
  for (const exact::GaussRule* rule : {&exact::gauss_rule(), &exact::short_gauss_rule()})
    for (std::size_t degree = 0; degree < 2 * rule->count; ++degree) {
      double sum = 0.0;
      for (std::size_t i = 0; i < rule->count; ++i)
        sum += rule->w[i] * std::pow(rule->x[i], static_cast<double>(degree));
      CHECK(sum == doctest::Approx(1.0 / static_cast<double>(degree + 1)).epsilon(1e-14));
    }
}

TEST_SUITE_END();
