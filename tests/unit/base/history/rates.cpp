// Histories and their rates, moved and repeated.
#include <doctest/doctest.h>

#include <cmath>

#include "signorini/history.hpp"

namespace signorini::tests::rates {
namespace {

/// 1 + 2 s + 3 s^2 + 0.5 sin(7 s + 0.3), s = t - 0.4, from 0.4 on; a line to 2 before.
History mixed() {
  Piece line, rest;
  line.coefficients = {0.0, 5.0};
  rest.origin = 0.4;
  rest.coefficients = {1.0, 2.0, 3.0};
  rest.amplitude = 0.5;
  rest.omega = 7.0;
  rest.phase = 0.3;
  return {{0.4}, {line, rest}};
}

}  // namespace

TEST_SUITE_BEGIN("unit/base/history/rates");

TEST_CASE("rates are the derivatives of the pieces") {
  const History f = mixed(), g = f.with_rates(0.7, -0.2, 0.05);
  for (const double t : {-0.3, 0.1, 0.4, 0.9, 1.7}) {
    const Piece& p = f.piece(t);
    const double expected = 0.7 * p.value(t) - 0.2 * p.value(t, 1) + 0.05 * p.value(t, 2);
    CHECK(g.value(t) == doctest::Approx(expected).epsilon(1e-13));
  }
  CHECK(f.with_rates(1.0, 0.0, 0.0).value(1.1) == f.value(1.1));
}

TEST_CASE("shifted: the same, later") {
  const History f = mixed(), g = f.shifted(0.75);
  for (const double t : {-0.3, 0.1, 0.4, 0.9, 1.7})
    CHECK(g.value(t + 0.75) == doctest::Approx(f.value(t)).epsilon(1e-14));
  CHECK(g.starts()[0] == 1.15);
}

TEST_CASE("repeated: a stretch again and again") {
  const History f = mixed(), g = f.repeated(0.1, 0.6, 4);
  CHECK(g.value(0.05) == f.value(0.05));
  for (const double s : {0.0, 0.2, 0.3, 0.55})
    for (const int round : {0, 1, 3})
      CHECK(g.value(0.1 + s + 0.6 * round) == doctest::Approx(f.value(0.1 + s)).epsilon(1e-12));
  CHECK(g.value(2.6) == f.value(2.6));  // as it is after the last round
  CHECK(g.breakpoints().size() == 4 + 4 + 1);
}

TEST_CASE("repeated: a shape that lasts its whole period has one piece less a round") {
  // 0.3 + 3 * 0.2 and 0.5 + 2 * 0.2 are not the same double.
  const History f({0.3, 0.5}, {Piece{}, Piece{0.3, {1.0}}, Piece{}});
  const History g = f.repeated(0.3, 0.2, 40);
  CHECK(g.starts().size() == 41);
  for (int i = 0; i < 400; ++i) CHECK(g.value(0.31 + 0.0199 * i) == 1.0);
  CHECK(g.value(8.31) == 0.0);
  CHECK(f.repeated(0.3, 0.21, 40).starts().size() == 81);
}

TEST_SUITE_END();

}  // namespace signorini::tests::rates
