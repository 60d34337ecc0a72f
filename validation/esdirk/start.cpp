#include <algorithm>

#include "integrator.hpp"

namespace signorini::esdirk {

double first_step(ModeFlow& flow, const Stretch& stretch, int from_order, int to_order) {
  constexpr double part = 0.4;  // as engine ida's
  if (!flow.linear()) return 0.0;
  const auto n = static_cast<std::size_t>(flow.size());
  std::vector<double> y(2 * n), dy(2 * n), w(2 * n);
  std::copy(stretch.u0.begin(), stretch.u0.end(), y.begin());
  std::copy(stretch.v0.begin(), stretch.v0.end(), y.begin() + static_cast<std::ptrdiff_t>(n));
  flow.weights(y.data(), w.data());
  double h = stretch.end - stretch.begin, factorial = 1.0;
  for (int q = 1; q <= to_order; ++q) {
    flow.derivative(stretch.begin, q - 1, y.data(), dy.data());
    std::swap(y, dy);
    factorial *= q;
    double sum = 0.0;
    for (std::size_t i = 0; i < 2 * n; ++i) sum += y[i] * w[i] * y[i] * w[i];
    const double norm = std::sqrt(sum / (2.0 * static_cast<double>(n)));
    if (q >= from_order && norm > 0.0) h = std::min(h, part * std::pow(factorial / norm, 1.0 / q));
  }
  return h;
}

long steps_to_length(const std::vector<double>& steps) {
  const double longest = *std::max_element(steps.begin(), steps.end());
  const auto first = std::find_if(steps.begin(), steps.end(), [&](double h) { return h >= 0.5 * longest; });
  return first - steps.begin() + 1;
}

}  // namespace signorini::esdirk
