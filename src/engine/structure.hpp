// structure.hpp: M, C and K on one common sparsity pattern.
//
//   r = M a + C v + K u        in one pass over the pattern
//
// Shapes: n degrees of freedom; compressed columns, rows ascending.
#pragma once

#include <cstdint>
#include <vector>

#include "signorini/model.hpp"

namespace signorini {

struct Structure {
  explicit Structure(const Model& model);

  int size = 0;
  std::vector<std::int64_t> column_start;
  std::vector<std::int64_t> row;
  std::vector<double> m, c, k;  ///< values of M, C, K, aligned with `row`

  /// r += M a + C v + K u
  void add_product(const double* a, const double* v, const double* u, double* r) const;
  /// x^T values x
  [[nodiscard]] double quadratic(const std::vector<double>& values, const double* x) const;
  /// r += values x, for one of m, c, k
  void add_product(const std::vector<double>& values, const double* x, double* r) const;
};

}  // namespace signorini
