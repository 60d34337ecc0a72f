#include "linear/triangular_factors.hpp"

namespace signorini {

std::size_t TriangularFactors::Columns::bytes() const {
  return sizeof(int) * (column.size() + end.size() + row.size()) + sizeof(double) * value.size();
}

std::size_t TriangularFactors::bytes() const {
  return lower_.bytes() + upper_.bytes() + off_.bytes() +
         sizeof(int) * (rows_.size() + columns_.size() + blocks_.size()) +
         sizeof(double) * (inverse_scale_.size() + inverse_pivot_.size());
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

void TriangularFactors::solve(double* b, double* x) const {
  const std::size_t n = rows_.size();
  for (std::size_t k = 0; k < n; ++k) x[k] = b[rows_[k]] * inverse_scale_[k];
  for (std::size_t block = blocks_.size() - 1; block-- > 0;) {
    const auto begin = static_cast<std::size_t>(blocks_[block]),
               end = static_cast<std::size_t>(blocks_[block + 1]);
    sweep(lower_, begin, end, x);
    for (std::size_t k = begin; k < end; ++k) x[k] *= inverse_pivot_[k];
    sweep(upper_, begin, end, x);
    if (block == 0 || off_.row.empty()) continue;
    auto p = static_cast<std::size_t>(off_.end[begin - 1]);
    for (std::size_t k = begin; k < end; ++k)
      for (; p < static_cast<std::size_t>(off_.end[k]); ++p) x[off_.row[p]] -= off_.value[p] * x[k];
  }
  for (std::size_t k = 0; k < n; ++k) b[columns_[k]] = x[k];
}

}  // namespace signorini
