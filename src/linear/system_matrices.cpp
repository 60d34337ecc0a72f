#include "linear/system_matrices.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/rounding.hpp"
#include "base/simd.hpp"

namespace signorini::linear {

SystemMatrices::SystemMatrices(const Model& model) : size(model.size()) {
  // Sums of magnitudes cannot cancel, so the pattern of this sum is the union of the three patterns.
  SparseMatrix pattern = model.mass.cwiseAbs() + model.damping.cwiseAbs() + model.stiffness.cwiseAbs();
  pattern.makeCompressed();
  column_start.push_back(0);
  for (int j = 0; j < size; ++j) {
    for (SparseMatrix::InnerIterator it(pattern, j); it; ++it) {
      row.push_back(static_cast<int>(it.row()));
      m.push_back(model.mass.coeff(it.row(), j));
      c.push_back(model.damping.coeff(it.row(), j));
      k.push_back(model.stiffness.coeff(it.row(), j));
    }
    column_start.push_back(static_cast<std::int64_t>(row.size()));
  }
  banded_ = BandedForces(column_start, row, c, k);
  const SparseMatrix both = model.damping + SparseMatrix(model.damping.transpose());
  for (int j = 0; j < size; ++j) {
    HalfColumn half;
    half.column = j;
    for (SparseMatrix::InnerIterator it(both, j); it; ++it) {
      if (it.row() == j) half.diagonal = 0.5 * it.value();
      if (it.row() >= j || it.value() == 0.0) continue;
      upper_row_.push_back(static_cast<int>(it.row()));
      upper_value_.push_back(it.value());
    }
    half.end = static_cast<int>(upper_row_.size());
    const bool empty = half.end == (half_.empty() ? 0 : half_.back().end);
    if (half.diagonal != 0.0 || !empty) half_.push_back(half);
  }
}

void SystemMatrices::subtract_forces(const double* v, const double* u, double* r) const {
  if (!banded_.empty()) return banded_.subtract(v, u, r);
  for (int j = 0; j < size; ++j) {
    const double vj = v[j], uj = u[j];
    const auto begin = static_cast<std::size_t>(column_start[static_cast<std::size_t>(j)]);
    const auto end = static_cast<std::size_t>(column_start[static_cast<std::size_t>(j) + 1]);
    for (std::size_t p = begin; p < end; ++p) r[row[p]] -= c[p] * vj + k[p] * uj;
  }
}

double SystemMatrices::damping_power(const double* v) const {
  double total = 0.0;
  int p = 0;
  for (const HalfColumn& half : half_) {
    const double vj = v[half.column];
    double sum = half.diagonal * vj;
    for (; p < half.end; ++p)
      sum += upper_value_[static_cast<std::size_t>(p)] * v[upper_row_[static_cast<std::size_t>(p)]];
    total += sum * vj;
  }
  return total;
}

void SystemMatrices::add_product(const double* a, const double* v, const double* u, double* r) const {
  for (int j = 0; j < size; ++j) {
    const double aj = a[j], vj = v[j], uj = u[j];
    const auto begin = static_cast<std::size_t>(column_start[static_cast<std::size_t>(j)]);
    const auto end = static_cast<std::size_t>(column_start[static_cast<std::size_t>(j) + 1]);
    for (std::size_t p = begin; p < end; ++p) r[row[p]] += m[p] * aj + c[p] * vj + k[p] * uj;
  }
}

void SystemMatrices::add_product(const std::vector<double>& values, const double* x, double* r) const {
  for (int j = 0; j < size; ++j) {
    const double xj = x[j];
    if (xj == 0.0) continue;
    const auto begin = static_cast<std::size_t>(column_start[static_cast<std::size_t>(j)]);
    const auto end = static_cast<std::size_t>(column_start[static_cast<std::size_t>(j) + 1]);
    for (std::size_t p = begin; p < end; ++p) r[row[p]] += values[p] * xj;
  }
}

double SystemMatrices::magnitude(const std::vector<double>& values, const double* x) const {
  double total = 0.0;
  for (int j = 0; j < size; ++j) {
    const auto begin = static_cast<std::size_t>(column_start[static_cast<std::size_t>(j)]);
    const auto end = static_cast<std::size_t>(column_start[static_cast<std::size_t>(j) + 1]);
    for (std::size_t p = begin; p < end; ++p) total += std::abs(values[p] * x[row[p]] * x[j]);
  }
  return total;
}

double SystemMatrices::quadratic(const std::vector<double>& values, const double* x) const {
  double total = 0.0;
  for (int j = 0; j < size; ++j) {
    const auto begin = static_cast<std::size_t>(column_start[static_cast<std::size_t>(j)]);
    const auto end = static_cast<std::size_t>(column_start[static_cast<std::size_t>(j) + 1]);
    double sum = 0.0;
    for (std::size_t p = begin; p < end; ++p) sum += values[p] * x[row[p]];
    total += sum * x[j];
  }
  return total;
}

namespace {

constexpr std::size_t rows_of_lanes = 4;
// Largest number of places in the band per matrix entry for which the band format saves time. One diagonal of four rows (two
// loads of matrix entries, two of motions) costs as much as three single entries.
constexpr std::size_t max_places_per_entry = 3;

/// Range [first, last) of the blocks of four rows for which all columns within the band width exist.
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
    base::Double4 sum = base::lanes_at<base::Double4>(r + row).v;
    for (std::size_t j = row - width; j <= row + width; ++j, entry += 2 * rows_of_lanes)
      sum -= base::lanes_at<base::Double4>(entry).v * base::lanes_at<base::Double4>(v + j).v +
             base::lanes_at<base::Double4>(entry + rows_of_lanes).v * base::lanes_at<base::Double4>(u + j).v;
    base::lanes_at<base::Double4>(r + row).v = sum;
  }
}

/// Calls take(row, index of its diagonal in the blocks, lane, column) for the entries of all rows outside the inner blocks.
template <class Take>
void visit_edge_entries(InnerBlocks blocks, std::size_t size, std::size_t width, const Take& take) {
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
  if (diagonals * size > max_places_per_entry * row.size()) return;
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
  visit_edge_entries(blocks, size_, width_,
                     [&](std::size_t i, std::size_t entry, std::size_t lane, std::size_t j) {
                       const double* f = values_.data() + entry * 2 * rows_of_lanes + lane;
                       r[i] -= f[0] * v[j] + f[rows_of_lanes] * u[j];
                     });
}

StructuralForces::StructuralForces(const Model& model, const SystemMatrices& structure)
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
      if (std::abs(rest) > rounding::few_operations * (std::abs(inertia) + std::abs(elastic)))
        rest_.push_back({i, j, rest});
    }
  if (!rest_.empty()) v_.resize(n);
}

void StructuralForces::apply(double* r) const {
  // A pair fits into one register, so both products of an entry are computed at once.
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

}  // namespace signorini::linear
