#include "run/stretch_peaks.hpp"

#include <algorithm>
#include <cmath>

namespace signorini {
namespace {

constexpr int halvings = 40;  // of the distance of two points: 1e-12 of the part, and p depends on its square

ValueBounds bounds_of(const Chebyshev::Values& values, std::size_t stride, bool between) {
  return between ? between_points(values, stride) : at_points(values, stride);
}

/// Largest value of p at one time, and its rate.
struct Crest {
  double value = 0.0, rate = 0.0;
};

class Crests {
 public:
  Crests(std::span<const Chebyshev::Values> f, std::size_t stride, double sign)
      : f_(f), stride_(stride), sign_(sign) {
    for (const Chebyshev::Values& values : f) rates_.push_back(Chebyshev::slopes(values, stride));
  }

  [[nodiscard]] Crest at(double t) const {
    Along::Values values = values_along(f_, stride_, t);
    for (double& value : values) value *= sign_;
    const Along::Extremes e = Along::extremes(values, f_.size());
    const Along::Values rates = values_along(rates_, stride_, t);
    return {e.greatest, sign_ * Along::through(rates, f_.size(), e.at_greatest)};
  }

 private:
  std::span<const Chebyshev::Values> f_;
  std::vector<Chebyshev::Values> rates_;
  std::size_t stride_;
  double sign_;
};

/// Value at which both tangents meet, at least the values at the ends: an upper bound.
double greatest_below_tangents(const Crest& a, const Crest& b, double width) {
  const double to = (b.value - a.value - b.rate * width) / (a.rate - b.rate);
  return std::max({a.value, b.value, a.value + a.rate * std::clamp(to, 0.0, width)});
}

}  // namespace

ValueBounds at_points(const Chebyshev::Values& values, std::size_t stride) {
  ValueBounds b{values[0], values[0]};
  for (std::size_t j = stride; j < Chebyshev::count; j += stride) {
    b.least = std::min(b.least, values[j]);
    b.greatest = std::max(b.greatest, values[j]);
  }
  return b;
}

ValueBounds between_points(const Chebyshev::Values& values, std::size_t stride) {
  const Chebyshev::Values& x = Chebyshev::nodes();
  const Chebyshev::Values slope = Chebyshev::slopes(values, stride);
  ValueBounds b = at_points(values, stride);
  for (std::size_t j = 0; j + stride < Chebyshev::count; j += stride) {
    const double sa = slope[j], sb = slope[j + stride], width = x[j + stride] - x[j];
    if ((sa > 0.0) == (sb > 0.0)) continue;
    const double to = (values[j + stride] - values[j] - sb * width) / (sa - sb);
    const double peak = values[j] + sa * std::clamp(to, 0.0, width);
    b.least = std::min(b.least, peak);
    b.greatest = std::max(b.greatest, peak);
  }
  return b;
}

ValueBounds bounds_along(std::span<const Chebyshev::Values> f, std::size_t stride, bool between) {
  ValueBounds b = bounds_of(f.front(), stride, between);
  const ValueBounds end = bounds_of(f.back(), stride, between);
  b = {std::min(b.least, end.least), std::max(b.greatest, end.greatest)};
  double off = 0.0;
  for (std::size_t i = 1; i + 1 < f.size(); ++i) {
    const double x = Along::point(f.size(), i);
    Chebyshev::Values bow{};
    for (std::size_t j = 0; j < Chebyshev::count; j += stride)
      bow[j] = f[i][j] - ((1.0 - x) * f.front()[j] + x * f.back()[j]);
    const ValueBounds of = bounds_of(bow, stride, between);
    off = std::max({off, of.greatest, -of.least});
  }
  return {b.least - Along::lebesgue * off, b.greatest + Along::lebesgue * off};
}

Along::Values values_along(std::span<const Chebyshev::Values> f, std::size_t stride, double x) {
  Along::Values values{};
  for (std::size_t i = 0; i < f.size(); ++i) values[i] = Chebyshev::through(f[i], stride, x);
  return values;
}

std::vector<double> peaks_along(std::span<const Chebyshev::Values> f, std::size_t stride, double sign,
                                double known) {
  const Crests crests(f, stride, sign);
  const Chebyshev::Values& x = Chebyshev::nodes();
  std::vector<double> peaks;
  Crest before = crests.at(x[0]);
  for (std::size_t j = stride; j < Chebyshev::count; j += stride) {
    const Crest after = crests.at(x[j]);
    const bool turns = before.rate > 0.0 && after.rate <= 0.0;
    if (turns && greatest_below_tangents(before, after, x[j] - x[j - stride]) > sign * known) {
      double rising = x[j - stride], falling = x[j];
      for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (rising + falling);
        (crests.at(middle).rate > 0.0 ? rising : falling) = middle;
      }
      peaks.push_back(0.5 * (rising + falling));
    }
    before = after;
  }
  return peaks;
}

}  // namespace signorini
