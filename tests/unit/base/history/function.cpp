#include <doctest/doctest.h>

#include <cmath>

#include "base/history/pieces.hpp"
#include "model/internal_units.hpp"
#include "signorini/smooth.hpp"

using namespace signorini;

namespace {

/// 2 + 3 t - t^3 two ways.
Piece cubic() {
  return Piece::of(smooth([](auto t) { return 2.0 + 3.0 * t - t * t * t; }));
}
Piece closed_cubic() {
  Piece piece;
  piece.coefficients = {2.0, 3.0, 0.0, -1.0};
  return piece;
}

void check_same(const History& a, const History& b) {
  for (const double t : {-0.4, 0.0, 0.3, 1.7})
    for (int order = 0; order < 5; ++order)
      CHECK(a.piece(t).value(t, order) == doctest::Approx(b.piece(t).value(t, order)).epsilon(1e-13));
}

}  // namespace

TEST_SUITE_BEGIN("unit/base/history/function");

TEST_CASE("derivatives of functions written for any kind of number") {
  const Function wave = smooth([](auto t) { return exp(-2.0 * t) * sin(3.0 * t); });
  const Function roots = smooth([](auto t) { return log(t) + sqrt(t) / cos(t) + pow(t, -1.5); });
  const double t = 0.7;
  // (d/dt)^k exp(-2t) sin 3t = 13^(k/2) exp(-2t) sin(3t + k (pi - atan 1.5))
  for (int k = 0; k < 12; ++k)
    CHECK(wave(t, k) == doctest::Approx(std::pow(13.0, 0.5 * k) * std::exp(-2.0 * t) *
                                        std::sin(3.0 * t + k * (std::acos(-1.0) - std::atan(1.5))))
                            .epsilon(1e-12));
  CHECK(wave(t, 12) == 0.0);
  CHECK(roots(t, 0) == doctest::Approx(std::log(t) + std::sqrt(t) / std::cos(t) + std::pow(t, -1.5)));
  CHECK(roots(t, 1) ==
        doctest::Approx(1.0 / t + 0.5 / std::sqrt(t) / std::cos(t) +
                        std::sqrt(t) * std::sin(t) / std::cos(t) / std::cos(t) - 1.5 * std::pow(t, -2.5)));
}

TEST_CASE("a function in a history is as good as its closed form") {
  const History own({1.0}, {cubic(), Piece{}}), closed({1.0}, {closed_cubic(), Piece{}});
  check_same(own, closed);
  check_same(own.scaled(-2.5, 0.5), closed.scaled(-2.5, 0.5));
  check_same(own.shifted(0.2), closed.shifted(0.2));
  check_same(own.with_rates(0.3, -1.1, 0.7), closed.with_rates(0.3, -1.1, 0.7));
  check_same(own.with_rates(0.0, 1.0, 0.0).with_rates(0.0, 1.0, 0.0), closed.with_rates(0.0, 0.0, 1.0));
  const Factors factors{8.0, 0.5, 4.0};
  check_same(model::rescaled(own, unit::velocity, factors), model::rescaled(closed, unit::velocity, factors));
  check_same(model::rescaled(own.with_rates(0.2, 1.0, 3.0), unit::force, factors),
             model::rescaled(closed.with_rates(0.2, 1.0, 3.0), unit::force, factors));
  double a[5], b[5];
  own.piece(0.3).taylor(0.3, 0.25, 5, a);
  closed.piece(0.3).taylor(0.3, 0.25, 5, b);
  for (int k = 0; k < 5; ++k) CHECK(a[k] == doctest::Approx(b[k]).epsilon(1e-14));
  CHECK(history::magnitude(own, 3.0) == doctest::Approx(4.0));
  CHECK(own.breakpoints().size() == 1);
  CHECK(own.breakpoints()[0].jump);
  CHECK_FALSE(own.is_constant());
  CHECK_FALSE(own.has_closed_form());
  CHECK(closed.has_closed_form());
  CHECK_THROWS_AS(static_cast<void>(own.integrated()), std::invalid_argument);
  CHECK(history::find_negative_time(own.scaled(1.0, -5.0), 0.5) >= 0.0);
  CHECK(history::find_negative_time(own, 0.9) < 0.0);
}

TEST_CASE("one history, then another") {
  const History first({1.0, 2.0}, {History::constant(1.0).piece(0.0), closed_cubic(), Piece{}});
  const History second({0.5, 3.0}, {Piece{}, History::constant(7.0).piece(0.0), closed_cubic()});
  const History both = first.then(1.5, second);
  CHECK(both.starts() == std::vector<double>{1.0, 1.5, 3.0});
  for (const double t : {0.2, 1.2}) CHECK(both.value(t) == first.value(t));
  for (const double t : {1.5, 2.9, 3.5}) CHECK(both.value(t) == second.value(t));
  CHECK(first.then(1.0, second).starts() == std::vector<double>{1.0, 3.0});
}

TEST_SUITE_END();
