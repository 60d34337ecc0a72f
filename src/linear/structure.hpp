// structure.hpp: M, C and K on one common sparsity pattern.
//
//   r = M a + C v + K u        in one pass over the pattern
//
// Shapes: n degrees of freedom; compressed columns, rows ascending.
#pragma once

#include <cstdint>
#include <vector>

#include "linear/banded_forces.hpp"
#include "signorini/model.hpp"

namespace signorini {

struct Structure {
  explicit Structure(const Model& model);

  int size = 0;
  std::vector<std::int64_t> column_start;
  std::vector<int> row;
  std::vector<double> m, c, k;  ///< values of M, C, K, aligned with `row`

  /// r += M a + C v + K u
  void add_product(const double* a, const double* v, const double* u, double* r) const;
  /// r -= C v + K u
  void subtract_forces(const double* v, const double* u, double* r) const;
  /// v^T C v, from half of the symmetric part, nonzero entries only.
  [[nodiscard]] double damping_power(const double* v) const;
  /// x^T values x
  [[nodiscard]] double quadratic(const std::vector<double>& values, const double* x) const;
  /// Sum of the magnitudes of the terms: reference for rounding.
  [[nodiscard]] double magnitude(const std::vector<double>& values, const double* x) const;
  /// r += values x, for one of m, c, k
  void add_product(const std::vector<double>& values, const double* x, double* r) const;

 private:
  struct HalfColumn {
    int column = 0, end = 0;  // end: end of its entries in half_row_
    double diagonal = 0.0;
  };
  BandedForces banded_;
  std::vector<HalfColumn> half_;
  std::vector<int> half_row_;
  std::vector<double> half_value_;  // c_ij + c_ji, i < j
};

}  // namespace signorini
