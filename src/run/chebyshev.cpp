#include "run/chebyshev.hpp"

#include <cmath>
#include <numbers>

#include "base/rounding.hpp"

namespace signorini {

namespace {

constexpr std::size_t last = Chebyshev::count - 1;

using Matrix = std::array<Chebyshev::Values, Chebyshev::count>;

/// Matrix of the factors of r_j - r_i in p'(x_i).
Matrix derivative(std::size_t stride) {
  const Chebyshev::Values& x = Chebyshev::nodes();
  Matrix d{};
  for (std::size_t i = 0; i <= last; i += stride)
    for (std::size_t j = 0; j <= last; j += stride) {
      if (i == j) continue;
      const double ci = i == 0 || i == last ? 2.0 : 1.0, cj = j == 0 || j == last ? 2.0 : 1.0;
      d[i][j] = ci / cj * ((i + j) / stride % 2 == 0 ? 1.0 : -1.0) / (x[i] - x[j]);
    }
  return d;
}

const Matrix& derivative_of(std::size_t stride) {
  static const std::array<Matrix, 4> all{derivative(1), derivative(2), derivative(4), derivative(8)};
  return all[stride == 1 ? 0 : stride == 2 ? 1 : stride == 4 ? 2 : 3];
}

}  // namespace

const Chebyshev::Values& Chebyshev::nodes() {
  static const Values x = [] {
    Values points{};
    for (std::size_t i = 0; i <= last; ++i)
      points[i] = -std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(last));
    points[last / 2] = 0.0;
    return points;
  }();
  return x;
}

double Chebyshev::through(const Values& values, std::size_t stride, double x) {
  double above = 0.0, below = 0.0, sign = 1.0;
  for (std::size_t i = 0; i <= last; i += stride, sign = -sign) {
    if (x == nodes()[i]) return values[i];
    const double w = sign * (i == 0 || i == last ? 0.5 : 1.0) / (x - nodes()[i]);
    above += w * values[i];
    below += w;
  }
  return above / below;
}

Chebyshev::Values Chebyshev::slopes(const Values& values, std::size_t stride) {
  const Matrix& d = derivative_of(stride);
  Values result{};
  // Differences are used, so that a constant has the derivative zero: the diagonal is minus the sum of its row.
  for (std::size_t i = 0; i <= last; i += stride)
    for (std::size_t j = 0; j <= last; j += stride) result[i] += d[i][j] * (values[j] - values[i]);
  return result;
}

double Chebyshev::turn_between(const Values& slope, std::size_t stride, double a, double b) {
  double fa = through(slope, stride, a);
  for (int i = 0; i < 60 && b - a > rounding::of_few; ++i) {
    const double middle = 0.5 * (a + b), f = through(slope, stride, middle);
    if ((f > 0.0) == (fa > 0.0)) {
      a = middle;
      fa = f;
    } else {
      b = middle;
    }
  }
  return 0.5 * (a + b);
}

}  // namespace signorini
