#include "engine/structure.hpp"

namespace signorini {

Structure::Structure(const Model& model) : size(model.size()) {
  // A sum of magnitudes cannot cancel, so its pattern is the union.
  SparseMatrix pattern = model.mass.cwiseAbs() + model.damping.cwiseAbs() + model.stiffness.cwiseAbs();
  pattern.makeCompressed();
  column_start.push_back(0);
  for (int j = 0; j < size; ++j) {
    for (SparseMatrix::InnerIterator it(pattern, j); it; ++it) {
      row.push_back(it.row());
      m.push_back(model.mass.coeff(it.row(), j));
      c.push_back(model.damping.coeff(it.row(), j));
      k.push_back(model.stiffness.coeff(it.row(), j));
    }
    column_start.push_back(static_cast<std::int64_t>(row.size()));
  }
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
