#include "sensitivity/forcing_rates.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace signorini;

namespace {

/// A piece all of whose numbers move with p.
Piece moving_piece(double p) {
  return {0.3 + 0.2 * p, {1.0 + p, -2.0 + 0.5 * p * p, 0.7 * p}, 1.5 + 0.1 * p, 3.0 + 0.4 * p, 0.2 - 0.3 * p};
}

}  // namespace

TEST_SUITE_BEGIN("unit/sensitivity/forcing_rates");

TEST_CASE("polynomials and sines whose origin, amplitude, frequency and phase move") {
  const double p = 1.3, t = 0.9, scale = 0.4;
  constexpr std::size_t count = 6;
  const Piece rates{0.2, {1.0, p, 0.7}, 0.1, 0.4, -0.3};
  std::vector<double> found(count, 0.25);
  sensitivity::add_rate_series(moving_piece(p), rates, t, scale, count, 2.0, found.data());
  const double h = 1e-3;
  std::vector<double> values[4];
  const double weights[4] = {1.0 / 12.0, -8.0 / 12.0, 8.0 / 12.0, -1.0 / 12.0};
  const double points[4] = {-2.0, -1.0, 1.0, 2.0};
  for (int i = 0; i < 4; ++i) {
    values[i].resize(count);
    moving_piece(p + points[i] * h).taylor(t, scale, count, values[i].data());
  }
  for (std::size_t k = 0; k < count; ++k) {
    CAPTURE(k);
    double difference = 0.0;
    for (int i = 0; i < 4; ++i) difference += weights[i] * values[i][k] / h;
    CHECK(std::abs(found[k] - (0.25 + 2.0 * difference)) < 1e-10);
  }
}

TEST_CASE("what stands still adds nothing") {
  std::vector<double> found(4, 0.0);
  sensitivity::add_rate_series(moving_piece(1.0), Piece{0.0, {0.0, 0.0, 0.0}, 0.0, 0.0, 0.0}, 0.5, 1.0, 4,
                               1.0, found.data());
  for (const double x : found) CHECK(x == 0.0);
}
