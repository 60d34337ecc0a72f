#include "orbit/special_points.hpp"

#include <algorithm>
#include <cmath>

namespace signorini {
namespace {

constexpr int most_places = 20;         // limit for a search
constexpr double sharp_enough = 1e-10;  // limit for a test function; chosen value
constexpr double real_enough = 1e-12;   // imaginary part of a real multiplier: rounding

}  // namespace

TestValues test_values(const Multipliers& all, std::size_t ones, double along, double error) {
  TestValues values;
  values.fold = along;
  double least = 0.0, greatest = 0.0, pair = 0.0;
  for (const auto& mu : without_ones(all, ones)) {
    if (std::abs(mu.imag()) > real_enough) {
      pair = std::max(pair, std::abs(mu));
      continue;
    }
    least = std::min(least, mu.real());
    greatest = std::max(greatest, mu.real());
  }
  // Within the error the value counts as zero, from inside.
  const auto inside = [error](double beyond) {
    return std::abs(beyond) <= error ? -std::min(error, sharp_enough) : beyond;
  };
  values.flip = -inside(-1.0 - least);
  values.neimark_sacker = inside(pair - 1.0);
  values.branch = inside(greatest - 1.0);
  return values;
}

std::optional<double> root_between(double a, double b,
                                   const std::function<std::optional<double>(double)>& f) {
  double lo = 0.0, hi = 1.0;
  int side = 0;
  for (int i = 0; i < most_places; ++i) {
    const double x = lo + (hi - lo) * a / (a - b);
    const std::optional<double> y = f(x);
    if (!y) return std::nullopt;
    if (std::abs(*y) <= sharp_enough || !(x > lo && x < hi)) return x;
    if ((*y < 0.0) == (a < 0.0)) {
      lo = x;
      a = *y;
      if (side < 0) b *= 0.5;
      side = -1;
    } else {
      hi = x;
      b = *y;
      if (side > 0) a *= 0.5;
      side = 1;
    }
  }
  return lo + (hi - lo) * a / (a - b);
}

}  // namespace signorini
