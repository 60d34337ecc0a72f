#include "linear/band_factors.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "base/wide_lanes.hpp"

namespace signorini {
namespace {

// Three digits, as pivots may lose that are kept for another length (linear/klu.cpp).
constexpr double most_growth = 1e3;
constexpr std::size_t lanes = 4;

/// row -= factor * pivots, both rounded up to whole lanes: what pivots have there is zero.
[[gnu::always_inline]] inline void eliminate(double factor, const double* pivots, std::size_t count,
                                             double* row) {
  for (std::size_t c = 0; c < count; c += lanes)
    lanes_at<Four>(row + c).v -= factor * lanes_at<Four>(pivots + c).v;
}

struct Band {
  std::size_t size, width, stride;
  double* values;
  double* sums;
  double* inverse_pivot;
};

/// Row after row; sums[i] += |l_ik u_ki|. False: a pivot is zero or no number.
SIGNORINI_WIDE_LANES bool eliminate_band(const Band& band) {
  for (std::size_t k = 0; k < band.size; ++k) {
    const double* pivots = band.values + k * band.stride + band.width;
    const double pivot = pivots[0];
    if (!(std::abs(pivot) > 0.0)) return false;
    const double inverse = 1.0 / pivot;
    band.inverse_pivot[k] = inverse;
    const std::size_t last = std::min(band.size - 1, k + band.width);
    for (std::size_t i = k + 1; i <= last; ++i) {
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

}  // namespace

BandFactors::BandFactors(std::size_t size, std::size_t width)
    : size_(size),
      width_(width),
      stride_((2 * width + 1 + 2 * lanes - 2) / lanes * lanes),
      values_(size * stride_ + lanes, 0.0),
      inverse_pivot_(size, 0.0),
      diagonal_(size, 0.0),
      sums_(size, 0.0) {}

void BandFactors::clear() { std::fill(values_.begin(), values_.end(), 0.0); }

bool BandFactors::factor() {
  for (std::size_t i = 0; i < size_; ++i) diagonal_[i] = std::abs(values_[i * stride_ + width_]);
  std::fill(sums_.begin(), sums_.end(), 0.0);
  if (!eliminate_band({size_, width_, stride_, values_.data(), sums_.data(), inverse_pivot_.data()}))
    return false;
  bool holds = true;
  for (std::size_t i = 0; i < size_; ++i) {
    const double pivot = std::abs(values_[i * stride_ + width_]), whole = sums_[i] + pivot;
    holds = holds && whole <= most_growth * diagonal_[i] && pivot > rounding::eps * whole;
  }
  return holds;
}

void BandFactors::solve(double* b) const {
  for (std::size_t i = 0; i < size_; ++i) {
    const std::size_t count = std::min(i, width_);
    const double *row = values_.data() + i * stride_ + width_ - count, *x = b + i - count;
    double sum = b[i];
    for (std::size_t c = 0; c < count; ++c) sum -= row[c] * x[c];
    b[i] = sum;
  }
  for (std::size_t i = size_; i-- > 0;) {
    const std::size_t count = std::min(size_ - 1 - i, width_);
    const double *row = values_.data() + i * stride_ + width_, *x = b + i;
    double sum = b[i];
    for (std::size_t c = count; c > 0; --c) sum -= row[c] * x[c];
    b[i] = sum * inverse_pivot_[i];
  }
}

}  // namespace signorini
