#include "linear/factor_reader.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace signorini {

void FactorReader::Raw::resize(std::size_t columns, Long entries) {
  start.resize(columns + 1);
  row.resize(static_cast<std::size_t>(entries) + 1);
  value.resize(static_cast<std::size_t>(entries) + 1);
}

/// Within each block by level; columns of one level are independent of each other.
void FactorReader::arrange(const std::vector<int>& level, bool backwards, std::vector<int>& columns) const {
  columns.resize(level.size());
  std::iota(columns.begin(), columns.end(), 0);
  for (std::size_t block = 0; block + 1 < blocks_.size(); ++block) {
    const auto begin = columns.begin() + blocks_[block], end = columns.begin() + blocks_[block + 1];
    if (backwards) std::reverse(begin, end);
    std::stable_sort(begin, end, [&](int a, int b) {
      return level[static_cast<std::size_t>(a)] < level[static_cast<std::size_t>(b)];
    });
  }
}

void FactorReader::order(Raw& raw, bool lower, Columns& c) const {
  // Diagonals stand first in columns of L and last in those of U.
  const std::size_t n = raw.start.size() - 1, first = lower ? 1 : 0, last = lower ? 0 : 1;
  std::vector<int> level(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = lower ? i : n - 1 - i;
    for (std::size_t p = raw.begin(k) + first; p + last < raw.begin(k + 1); ++p) {
      int& of_row = level[static_cast<std::size_t>(raw.row[p])];
      of_row = std::max(of_row, level[k] + 1);
    }
  }
  arrange(level, !lower, c.column);
  c.end.clear();
  c.row.clear();
  raw.from.clear();
  for (const int column : c.column) {
    const auto k = static_cast<std::size_t>(column);
    for (std::size_t p = raw.begin(k) + first; p + last < raw.begin(k + 1); ++p) {
      c.row.push_back(static_cast<int>(raw.row[p]));
      raw.from.push_back(p);
    }
    c.end.push_back(static_cast<int>(c.row.size()));
  }
  c.value.resize(c.row.size());
}

void FactorReader::make_room(const klu_l_symbolic& symbolic, const klu_l_numeric& numeric) {
  const auto n = static_cast<std::size_t>(symbolic.n);
  lower_.resize(n, numeric.lnz);
  upper_.resize(n, numeric.unz);
  off_.resize(n, numeric.nzoff);
  rows_.resize(n);
  columns_.resize(n);
  blocks_.resize(static_cast<std::size_t>(symbolic.nblocks) + 1);
  scale_.resize(n);
}

void FactorReader::read_pattern(TriangularFactors& factors) {
  factors.rows_.assign(rows_.begin(), rows_.end());
  factors.columns_.assign(columns_.begin(), columns_.end());
  factors.blocks_.assign(blocks_.begin(), blocks_.end());
  factors.inverse_scale_.resize(scale_.size());
  factors.inverse_pivot_.resize(scale_.size());
  order(lower_, true, factors.lower_);
  order(upper_, false, factors.upper_);
  factors.off_.end.assign(off_.start.begin() + 1, off_.start.end());
  factors.off_.row.assign(off_.row.begin(), off_.row.begin() + off_.start.back());
  factors.off_.value.resize(factors.off_.row.size());
}

void FactorReader::read(klu_l_symbolic* symbolic, klu_l_numeric* numeric, klu_l_common* common, bool pattern,
                        TriangularFactors& factors) {
  if (pattern) make_room(*symbolic, *numeric);
  if (klu_l_extract(numeric, symbolic, lower_.start.data(), lower_.row.data(), lower_.value.data(),
                    upper_.start.data(), upper_.row.data(), upper_.value.data(), off_.start.data(),
                    off_.row.data(), off_.value.data(), rows_.data(), columns_.data(), scale_.data(),
                    blocks_.data(), common) == 0)
    throw std::runtime_error("KLU's factors could not be read");
  if (pattern) read_pattern(factors);
  for (std::size_t k = 0; k < scale_.size(); ++k) {
    factors.inverse_pivot_[k] = 1.0 / upper_.value[upper_.begin(k + 1) - 1];
    factors.inverse_scale_[k] = 1.0 / scale_[k];
  }
  Columns &lower = factors.lower_, &upper = factors.upper_, &off = factors.off_;
  for (std::size_t p = 0; p < lower.value.size(); ++p) lower.value[p] = lower_.value[lower_.from[p]];
  for (std::size_t p = 0; p < upper.value.size(); ++p)
    upper.value[p] =
        upper_.value[upper_.from[p]] * factors.inverse_pivot_[static_cast<std::size_t>(upper.row[p])];
  std::copy(off_.value.begin(), off_.value.begin() + static_cast<std::ptrdiff_t>(off.value.size()),
            off.value.begin());
}

}  // namespace signorini
