#include "linear/momentum.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "base/wide_lanes.hpp"

namespace signorini {
namespace {

// A band's entry costs a quarter of a row's, which comes with its column: chosen.
constexpr std::size_t most_fill = 4;

const Four& wide(const double* p) { return *reinterpret_cast<const Four*>(p); }
Four& wide(double* p) { return *reinterpret_cast<Four*>(p); }

/// r = M x_m + K x_k for n rows, the last of which may be fewer than four; x_m, x_k: of column -reach.
SIGNORINI_WIDE_LANES void apply_band(const double* values, const double* x_m, const double* x_k,
                                     std::size_t diagonals, std::size_t n, double* r) {
  for (std::size_t i = 0; i < n; i += 4) {
    Four m{}, k{};
    for (std::size_t d = 0; d < diagonals; ++d, values += 8) {
      m += wide(values) * wide(x_m + i + d);
      k += wide(values + 4) * wide(x_k + i + d);
    }
    const Four sum = m + k;
    if (i + 4 <= n) {
      wide(r + i) = sum;
    } else {
      for (std::size_t j = 0; i + j < n; ++j) r[i + j] = sum[j];
    }
  }
}

/// x_m = a + alpha v,  x_k = u + beta v
SIGNORINI_WIDE_LANES void put_columns(std::size_t n, double alpha, double beta, const double* a,
                                      const double* v, const double* u, double* x_m, double* x_k) {
  std::size_t i = 0;
  for (; i + 3 < n; i += 4) {
    wide(x_m + i) = wide(a + i) + alpha * wide(v + i);
    wide(x_k + i) = wide(u + i) + beta * wide(v + i);
  }
  for (; i < n; ++i) {
    x_m[i] = a[i] + alpha * v[i];
    x_k[i] = u[i] + beta * v[i];
  }
}

}  // namespace

Momentum::Momentum(const Model& model, const Structure& structure)
    : alpha_(model.alpha),
      beta_(model.beta),
      size_(static_cast<std::size_t>(structure.size)),
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
  make_band(structure);
}

void Momentum::make_band(const Structure& structure) {
  std::size_t reach = 0;
  for (std::size_t i = 0; i < size_; ++i)
    for (auto p = static_cast<std::size_t>(row_start_[i]); p < static_cast<std::size_t>(row_start_[i + 1]);
         ++p) {
      const auto j = static_cast<std::size_t>(column_[p]);
      reach = std::max(reach, std::max(i, j) - std::min(i, j));
    }
  const std::size_t diagonals = 2 * reach + 1, fours = (size_ + 3) / 4;
  if (size_ < 4 || diagonals * 4 * fours > most_fill * structure.row.size()) return;
  reach_ = reach;
  band_.assign(8 * diagonals * fours, 0.0);
  for (std::size_t i = 0; i < size_; ++i)
    for (auto p = static_cast<std::size_t>(row_start_[i]); p < static_cast<std::size_t>(row_start_[i + 1]);
         ++p) {
      const std::size_t d = static_cast<std::size_t>(column_[p]) + reach - i;
      double* const at = band_.data() + 8 * (diagonals * (i / 4) + d) + i % 4;
      at[0] = values_[2 * p];
      at[4] = values_[2 * p + 1];
    }
  stride_ = 1;
  for_m_ = reach;
  for_k_ = 4 * fours + 3 * reach;
  x_.assign(2 * (4 * fours + 2 * reach), 0.0);
}

void Momentum::put(const double* a, const double* v, const double* u) {
  if (band_.empty()) {
    for (std::size_t i = 0; i < size_; ++i) put(i, a[i], v[i], u[i]);
    return;
  }
  put_columns(size_, alpha_, beta_, a, v, u, x_.data() + for_m_, x_.data() + for_k_);
  if (!rest_.empty()) std::copy(v, v + size_, v_.begin());
}

void Momentum::apply(double* r) const {
  if (band_.empty())
    apply_rows(r);
  else
    apply_band(band_.data(), x_.data() + for_m_ - reach_, x_.data() + for_k_ - reach_, 2 * reach_ + 1, size_,
               r);
  for (const Entry& entry : rest_) r[entry.row] += entry.value * v_[entry.column];
}

void Momentum::apply_rows(double* r) const {
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
}

}  // namespace signorini
