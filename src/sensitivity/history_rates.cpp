#include "sensitivity/history_rates.hpp"

#include <numbers>

namespace signorini {

void add_rate_series(const Piece& piece, const Piece& rates, double t, double scale, std::size_t count,
                     double factor, double* out) {
  std::vector<double> series(count);
  const auto add = [&](const Piece& part, double times) {
    part.taylor(t, scale, count, series.data());
    for (std::size_t k = 0; k < count; ++k) out[k] += factor * times * series[k];
  };
  Piece shape{piece.origin, rates.coefficients, rates.amplitude, piece.omega, piece.phase};
  for (std::size_t j = 0; j + 1 < piece.coefficients.size(); ++j)
    shape.coefficients[j] -= rates.origin * static_cast<double>(j + 1) * piece.coefficients[j + 1];
  add(shape, 1.0);
  const double turn = rates.phase - piece.omega * rates.origin;
  if (piece.amplitude == 0.0 || (turn == 0.0 && rates.omega == 0.0)) return;
  const Piece cosine{piece.origin, {}, piece.amplitude, piece.omega, piece.phase + 0.5 * std::numbers::pi};
  cosine.taylor(t, scale, count, series.data());
  const double constant = turn + rates.omega * (t - piece.origin), slope = rates.omega * scale;
  for (std::size_t k = 0; k < count; ++k)
    out[k] += factor * (constant * series[k] + (k > 0 ? slope * series[k - 1] : 0.0));
}

}  // namespace signorini
