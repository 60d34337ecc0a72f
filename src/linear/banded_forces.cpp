#include "linear/banded_forces.hpp"

#include <algorithm>
#include <cstdint>

#include "base/wide_lanes.hpp"

namespace signorini {
namespace {

constexpr std::size_t rows_of_lanes = 4;
// Greatest number of band places for each entry: a diagonal of four rows, two loads of matrices and two of motions,
// costs as much as three entries one by one.
constexpr std::size_t most_of_entries = 3;

/// Blocks of rows whose columns all exist: [first, last).
struct InnerBlocks {
  std::size_t first, last;
};

InnerBlocks inner_blocks(std::size_t size, std::size_t width) {
  const std::size_t first = (width + rows_of_lanes - 1) / rows_of_lanes;
  const std::size_t last = size >= width + rows_of_lanes ? (size - width) / rows_of_lanes : 0;
  return {first, std::max(first, last)};
}

SIGNORINI_WIDE_LANES void subtract_blocks(InnerBlocks blocks, std::size_t width, const double* forces,
                                          const double* v, const double* u, double* r) {
  const std::size_t diagonals = 2 * width + 1;
  for (std::size_t block = blocks.first; block < blocks.last; ++block) {
    const std::size_t row = block * rows_of_lanes;
    const double* entry = forces + block * diagonals * 2 * rows_of_lanes;
    Four sum = lanes_at<Four>(r + row).v;
    for (std::size_t j = row - width; j <= row + width; ++j, entry += 2 * rows_of_lanes)
      sum -= lanes_at<Four>(entry).v * lanes_at<Four>(v + j).v +
             lanes_at<Four>(entry + rows_of_lanes).v * lanes_at<Four>(u + j).v;
    lanes_at<Four>(r + row).v = sum;
  }
}

/// Calls take(row, diagonal of its block, lane, column) for the entries of rows before and after the inner blocks.
template <class Take>
void at_edges(InnerBlocks blocks, std::size_t size, std::size_t width, const Take& take) {
  const auto rows = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t j = i - std::min(i, width); j <= std::min(size - 1, i + width); ++j)
        take(i, (i / rows_of_lanes) * (2 * width + 1) + (j + width - i), i % rows_of_lanes, j);
  };
  rows(0, std::min(size, blocks.first * rows_of_lanes));
  rows(std::min(size, blocks.last * rows_of_lanes), size);
}

}  // namespace

BandedForces::BandedForces(const std::vector<std::int64_t>& column_start, const std::vector<int>& row,
                           const std::vector<double>& c, const std::vector<double>& k) {
  const std::size_t size = column_start.size() - 1;
  const auto each = [&](const auto& take) {
    for (std::size_t j = 0; j < size; ++j)
      for (auto p = static_cast<std::size_t>(column_start[j]);
           p < static_cast<std::size_t>(column_start[j + 1]); ++p)
        take(static_cast<std::size_t>(row[p]), j, p);
  };
  std::size_t width = 0;
  each([&](std::size_t i, std::size_t j, std::size_t) { width = std::max(width, i > j ? i - j : j - i); });
  const std::size_t diagonals = 2 * width + 1;
  if (diagonals * size > most_of_entries * row.size()) return;
  size_ = size;
  width_ = width;
  const std::size_t blocks = (size + rows_of_lanes - 1) / rows_of_lanes;
  values_.assign(blocks * diagonals * 2 * rows_of_lanes, 0.0);
  each([&](std::size_t i, std::size_t j, std::size_t p) {
    const std::size_t entry = (i / rows_of_lanes) * diagonals + (j + width - i), lane = i % rows_of_lanes;
    values_[entry * 2 * rows_of_lanes + lane] = c[p];
    values_[(entry * 2 + 1) * rows_of_lanes + lane] = k[p];
  });
}

void BandedForces::subtract(const double* v, const double* u, double* r) const {
  const InnerBlocks blocks = inner_blocks(size_, width_);
  subtract_blocks(blocks, width_, values_.data(), v, u, r);
  at_edges(blocks, size_, width_, [&](std::size_t i, std::size_t entry, std::size_t lane, std::size_t j) {
    const double* f = values_.data() + entry * 2 * rows_of_lanes + lane;
    r[i] -= f[0] * v[j] + f[rows_of_lanes] * u[j];
  });
}

}  // namespace signorini
