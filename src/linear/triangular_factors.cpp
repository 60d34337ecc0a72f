#include "linear/triangular_factors.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace signorini {

void TriangularFactors::Raw::resize(std::size_t columns, SuiteSparse_long entries) {
  start.resize(columns + 1);
  row.resize(static_cast<std::size_t>(entries) + 1);
  value.resize(static_cast<std::size_t>(entries) + 1);
}

/// Within each block by level; columns of one level are independent of each other.
void TriangularFactors::arrange(const std::vector<int>& level, const std::vector<SuiteSparse_long>& blocks,
                                bool backwards, std::vector<int>& columns) {
  columns.resize(level.size());
  std::iota(columns.begin(), columns.end(), 0);
  for (std::size_t block = 0; block + 1 < blocks.size(); ++block) {
    const auto begin = columns.begin() + blocks[block], end = columns.begin() + blocks[block + 1];
    if (backwards) std::reverse(begin, end);
    std::stable_sort(begin, end, [&](int a, int b) {
      return level[static_cast<std::size_t>(a)] < level[static_cast<std::size_t>(b)];
    });
  }
}

void TriangularFactors::order(const Raw& raw, const std::vector<SuiteSparse_long>& blocks, bool lower,
                              Columns& c) {
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
  arrange(level, blocks, !lower, c.column);
  c.end.clear();
  c.row.clear();
  c.from.clear();
  for (const int column : c.column) {
    const auto k = static_cast<std::size_t>(column);
    for (std::size_t p = raw.begin(k) + first; p + last < raw.begin(k + 1); ++p) {
      c.row.push_back(static_cast<int>(raw.row[p]));
      c.from.push_back(p);
    }
    c.end.push_back(static_cast<int>(c.row.size()));
  }
  c.value.resize(c.row.size());
}

void TriangularFactors::take(klu_l_symbolic* symbolic, klu_l_numeric* numeric, klu_l_common* common,
                             bool pattern) {
  const auto n = static_cast<std::size_t>(symbolic->n);
  if (pattern) {
    raw_lower_.resize(n, numeric->lnz);
    raw_upper_.resize(n, numeric->unz);
    raw_off_.resize(n, numeric->nzoff);
    rows_long_.resize(n);
    columns_long_.resize(n);
    blocks_.resize(static_cast<std::size_t>(symbolic->nblocks) + 1);
    for (std::vector<double>* v : {&scale_, &inverse_scale_, &inverse_pivot_, &x_}) v->resize(n);
  }
  if (klu_l_extract(numeric, symbolic, raw_lower_.start.data(), raw_lower_.row.data(),
                    raw_lower_.value.data(), raw_upper_.start.data(), raw_upper_.row.data(),
                    raw_upper_.value.data(), raw_off_.start.data(), raw_off_.row.data(),
                    raw_off_.value.data(), rows_long_.data(), columns_long_.data(), scale_.data(),
                    blocks_.data(), common) == 0)
    throw std::runtime_error("KLU's factors could not be read");
  if (pattern) {
    rows_.assign(rows_long_.begin(), rows_long_.end());
    columns_.assign(columns_long_.begin(), columns_long_.end());
    order(raw_lower_, blocks_, true, lower_);
    order(raw_upper_, blocks_, false, upper_);
    off_.end.assign(raw_off_.start.begin() + 1, raw_off_.start.end());
    off_.row.assign(raw_off_.row.begin(), raw_off_.row.begin() + raw_off_.start.back());
  }
  for (std::size_t k = 0; k < n; ++k) {
    inverse_pivot_[k] = 1.0 / raw_upper_.value[raw_upper_.begin(k + 1) - 1];
    inverse_scale_[k] = 1.0 / scale_[k];
  }
  for (std::size_t p = 0; p < lower_.from.size(); ++p) lower_.value[p] = raw_lower_.value[lower_.from[p]];
  for (std::size_t p = 0; p < upper_.from.size(); ++p)
    upper_.value[p] =
        raw_upper_.value[upper_.from[p]] * inverse_pivot_[static_cast<std::size_t>(upper_.row[p])];
}

/// x_row -= value x_column for the columns number [begin, end) of the sweep.
void TriangularFactors::sweep(const Columns& c, std::size_t begin, std::size_t end, double* x) {
  auto p = static_cast<std::size_t>(begin == 0 ? 0 : c.end[begin - 1]);
  const int* row = c.row.data();
  const double* value = c.value.data();
  for (std::size_t i = begin; i < end; ++i) {
    const auto stop = static_cast<std::size_t>(c.end[i]);
    const double xk = x[c.column[i]];
    for (; p < stop; ++p) x[row[p]] -= value[p] * xk;
  }
}

void TriangularFactors::solve(double* b) {
  const std::size_t n = rows_.size();
  double* x = x_.data();
  for (std::size_t k = 0; k < n; ++k) x[k] = b[rows_[k]] * inverse_scale_[k];
  for (std::size_t block = blocks_.size() - 1; block-- > 0;) {
    const auto begin = static_cast<std::size_t>(blocks_[block]),
               end = static_cast<std::size_t>(blocks_[block + 1]);
    sweep(lower_, begin, end, x);
    for (std::size_t k = begin; k < end; ++k) x[k] *= inverse_pivot_[k];
    sweep(upper_, begin, end, x);
    if (block == 0 || off_.row.empty()) continue;
    auto p = static_cast<std::size_t>(raw_off_.start[begin]);
    for (std::size_t k = begin; k < end; ++k)
      for (; p < static_cast<std::size_t>(off_.end[k]); ++p) x[off_.row[p]] -= raw_off_.value[p] * x[k];
  }
  for (std::size_t k = 0; k < n; ++k) b[columns_[k]] = x[k];
}

}  // namespace signorini
