#include "linear/structure.hpp"

#include <cmath>

namespace signorini {

Structure::Structure(const Model& model) : size(model.size()) {
  // A sum of magnitudes cannot cancel, so its pattern is the union.
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
      half_row_.push_back(static_cast<int>(it.row()));
      half_value_.push_back(it.value());
    }
    half.end = static_cast<int>(half_row_.size());
    const bool empty = half.end == (half_.empty() ? 0 : half_.back().end);
    if (half.diagonal != 0.0 || !empty) half_.push_back(half);
  }
}

void Structure::subtract_forces(const double* v, const double* u, double* r) const {
  if (!banded_.empty()) return banded_.subtract(v, u, r);
  for (int j = 0; j < size; ++j) {
    const double vj = v[j], uj = u[j];
    const auto begin = static_cast<std::size_t>(column_start[static_cast<std::size_t>(j)]);
    const auto end = static_cast<std::size_t>(column_start[static_cast<std::size_t>(j) + 1]);
    for (std::size_t p = begin; p < end; ++p) r[row[p]] -= c[p] * vj + k[p] * uj;
  }
}

double Structure::damping_power(const double* v) const {
  double total = 0.0;
  int p = 0;
  for (const HalfColumn& half : half_) {
    const double vj = v[half.column];
    double sum = half.diagonal * vj;
    for (; p < half.end; ++p)
      sum += half_value_[static_cast<std::size_t>(p)] * v[half_row_[static_cast<std::size_t>(p)]];
    total += sum * vj;
  }
  return total;
}

void Structure::add_product(const double* a, const double* v, const double* u, double* r) const {
  for (int j = 0; j < size; ++j) {
    const double aj = a[j], vj = v[j], uj = u[j];
    const auto begin = static_cast<std::size_t>(column_start[static_cast<std::size_t>(j)]);
    const auto end = static_cast<std::size_t>(column_start[static_cast<std::size_t>(j) + 1]);
    for (std::size_t p = begin; p < end; ++p) r[row[p]] += m[p] * aj + c[p] * vj + k[p] * uj;
  }
}

void Structure::add_product(const std::vector<double>& values, const double* x, double* r) const {
  for (int j = 0; j < size; ++j) {
    const double xj = x[j];
    if (xj == 0.0) continue;
    const auto begin = static_cast<std::size_t>(column_start[static_cast<std::size_t>(j)]);
    const auto end = static_cast<std::size_t>(column_start[static_cast<std::size_t>(j) + 1]);
    for (std::size_t p = begin; p < end; ++p) r[row[p]] += values[p] * xj;
  }
}

double Structure::magnitude(const std::vector<double>& values, const double* x) const {
  double total = 0.0;
  for (int j = 0; j < size; ++j) {
    const auto begin = static_cast<std::size_t>(column_start[static_cast<std::size_t>(j)]);
    const auto end = static_cast<std::size_t>(column_start[static_cast<std::size_t>(j) + 1]);
    for (std::size_t p = begin; p < end; ++p) total += std::abs(values[p] * x[row[p]] * x[j]);
  }
  return total;
}

double Structure::quadratic(const std::vector<double>& values, const double* x) const {
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

}  // namespace signorini
