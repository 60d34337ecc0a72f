#include "linear/momentum.hpp"

#include <cmath>

#include "base/rounding.hpp"

namespace signorini {

Momentum::Momentum(const Model& model, const Structure& structure)
    : alpha_(model.alpha),
      beta_(model.beta),
      row_start_(static_cast<std::size_t>(structure.size) + 1, 0),
      column_(structure.row.size()),
      values_(2 * structure.row.size()),
      x_(2 * static_cast<std::size_t>(structure.size)) {
  const auto n = static_cast<std::size_t>(structure.size);
  for (const int i : structure.row) ++row_start_[static_cast<std::size_t>(i) + 1];
  for (std::size_t i = 0; i < n; ++i) row_start_[i + 1] += row_start_[i];
  std::vector<int> next(row_start_.begin(), row_start_.end() - 1);
  for (std::size_t j = 0; j < n; ++j)
    for (auto p = static_cast<std::size_t>(structure.column_start[j]);
         p < static_cast<std::size_t>(structure.column_start[j + 1]); ++p) {
      const auto i = static_cast<std::size_t>(structure.row[p]);
      const auto at = static_cast<std::size_t>(next[i]++);
      column_[at] = static_cast<int>(j);
      values_[2 * at] = structure.m[p];
      values_[2 * at + 1] = structure.k[p];
      const double inertia = alpha_ * structure.m[p], elastic = beta_ * structure.k[p];
      const double rest = structure.c[p] - (inertia + elastic);
      if (std::abs(rest) > rounding::of_few * (std::abs(inertia) + std::abs(elastic)))
        rest_.push_back({i, j, rest});
    }
  if (!rest_.empty()) v_.resize(n);
}

void Momentum::apply(double* r) const {
  // Both products of an entry at once: pairs are one register.
  using Pair = Eigen::Map<const Eigen::Array2d>;
  const double *value = values_.data(), *x = x_.data();
  const int* column = column_.data();
  const std::size_t n = row_start_.size() - 1;
  for (std::size_t i = 0; i < n; ++i) {
    Eigen::Array2d sum(0.0, 0.0);
    for (const int* end = column_.data() + row_start_[i + 1]; column != end; ++column, value += 2)
      sum += Pair(value) * Pair(x + 2 * static_cast<std::size_t>(*column));
    r[i] = sum[0] + sum[1];
  }
  for (const Entry& entry : rest_) r[entry.row] += entry.value * v_[entry.column];
}

}  // namespace signorini
