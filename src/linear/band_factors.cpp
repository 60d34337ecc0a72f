#include "linear/band_factors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/rounding.hpp"
#include "base/simd.hpp"

namespace signorini::linear {
namespace {

// Largest accepted ratio of sum_k |l_ik u_ki| to |a_ii|. It corresponds to a loss of three digits, the same limit as for
// pivots kept from another step size (linear/klu.cpp).
constexpr double max_elimination_growth = 1e3;
constexpr std::size_t lanes = 4;

/// row -= factor * pivots, for `count` numbers. Both arrays are padded to a multiple of `lanes`, `pivots` with zeros.
[[gnu::always_inline]] inline void eliminate(double factor, const double* pivots, std::size_t count,
                                             double* row) {
  for (std::size_t c = 0; c < count; c += lanes)
    base::lanes_at<base::Double4>(row + c).v -= factor * base::lanes_at<base::Double4>(pivots + c).v;
}

struct Band {
  std::size_t width, stride;
  double* values;
  double* sums;
  double* inverse_pivot;
};

/// Eliminates rows [begin, end) one by one and adds |l_ik u_ki| to sums[i]. False: a pivot is zero or NaN.
SIGNORINI_WIDE_LANES bool eliminate_band(const Band& band, std::size_t begin, std::size_t end) {
  for (std::size_t k = begin - std::min(begin, band.width); k < end; ++k) {
    const double* pivots = band.values + k * band.stride + band.width;
    if (k >= begin) {
      if (!(std::abs(pivots[0]) > 0.0)) return false;
      band.inverse_pivot[k] = 1.0 / pivots[0];
    }
    const double inverse = band.inverse_pivot[k];
    const std::size_t last = std::min(end - 1, k + band.width);
    for (std::size_t i = std::max(begin, k + 1); i <= last; ++i) {
      double* row = band.values + i * band.stride + band.width - (i - k);
      if (row[0] == 0.0) continue;
      const double factor = row[0] * inverse;
      row[0] = factor;
      band.sums[i] += std::abs(factor * pivots[i - k]);
      eliminate(factor, pivots + 1, band.width, row + 1);
    }
  }
  return true;
}

[[gnu::always_inline]] inline void solve_band_of_width(std::size_t width, std::size_t size,
                                                       std::size_t stride, const double* values,
                                                       const double* inverse_pivot, double* b) {
  const auto forward = [&](std::size_t i, std::size_t count) {
    const double *row = values + i * stride + width - count, *x = b + i - count;
    double sum = b[i];
    for (std::size_t c = 0; c < count; ++c) sum -= row[c] * x[c];
    b[i] = sum;
  };
  const auto back = [&](std::size_t i, std::size_t count) {
    const double *row = values + i * stride + width, *x = b + i;
    double sum = b[i];
    for (std::size_t c = count; c > 0; --c) sum -= row[c] * x[c];
    b[i] = sum * inverse_pivot[i];
  };
  const std::size_t edge = std::min(width, size);
  for (std::size_t i = 0; i < edge; ++i) forward(i, i);
  for (std::size_t i = edge; i < size; ++i) forward(i, width);
  for (std::size_t i = size; i-- > size - edge;) back(i, size - 1 - i);
  for (std::size_t i = size - edge; i-- > 0;) back(i, width);
}

/// solve_band_of_width() for a width that is known at compile time.
template <std::size_t width>
void solve_band(std::size_t size, std::size_t stride, const double* values, const double* inverse_pivot,
                double* b) {
  solve_band_of_width(width, size, stride, values, inverse_pivot, b);
}

/// Largest width with a solver compiled for it; it covers chains of nodes with two or three unknowns each.
constexpr std::size_t max_unrolled_width = 8;

}  // namespace

BandFactors::BandFactors(std::size_t size, std::size_t width)
    : size_(size),
      width_(width),
      stride_((2 * width + 1 + 2 * lanes - 2) / lanes * lanes),
      values_(size * stride_ + lanes, 0.0),
      inverse_pivot_(size, 0.0),
      diagonal_(size, 0.0),
      sums_(size, 0.0) {}

void BandFactors::clear(std::size_t begin, std::size_t end) {
  std::fill(row(begin), row(begin) + (end - begin) * stride_, 0.0);
}

bool BandFactors::factor(std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    diagonal_[i] = std::abs(values_[i * stride_ + width_]);
    sums_[i] = 0.0;
  }
  if (!eliminate_band({width_, stride_, values_.data(), sums_.data(), inverse_pivot_.data()}, begin, end))
    return false;
  bool holds = true;
  for (std::size_t i = begin; i < end; ++i) {
    const double pivot = std::abs(values_[i * stride_ + width_]), whole = sums_[i] + pivot;
    holds = holds && whole <= max_elimination_growth * diagonal_[i] && pivot > rounding::eps * whole;
  }
  return holds;
}

void BandFactors::solve(double* b) const {
  const auto with = [&]<std::size_t... W>(std::index_sequence<W...>) {
    const bool narrow =
        ((width_ == W && (solve_band<W>(size_, stride_, values_.data(), inverse_pivot_.data(), b), true)) ||
         ...);
    if (!narrow) solve_band_of_width(width_, size_, stride_, values_.data(), inverse_pivot_.data(), b);
  };
  with(std::make_index_sequence<max_unrolled_width + 1>());
}

}  // namespace signorini::linear
