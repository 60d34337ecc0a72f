// system_matrices.hpp: M, C and K on one common sparsity pattern.
//
//   r = M a + C v + K u        in one pass over the pattern
//
// n degrees of freedom; matrices are stored by compressed columns, with rows in ascending order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "signorini/model.hpp"

namespace signorini::linear {

// Forces of a structure with narrow band matrices, computed for four rows at once.
//
//   r_i -= sum_j ( c_ij v_j + k_ij u_j ),   j from i - width to i + width
//
// In a product column by column each sum must wait until the previous sum is stored. Here four rows are computed in parallel,
// diagonal by diagonal. Each row adds its terms in the order of the columns and missing entries add zero, so the results are
// bitwise those of the product column by column.

class BandedForces {
 public:
  BandedForces() = default;
  /// Stays empty if the band would have far more places than the matrices have entries. column_start, row: the pattern by
  /// compressed columns; c, k: values of C and K, aligned with `row`.
  BandedForces(const std::vector<std::int64_t>& column_start, const std::vector<int>& row,
               const std::vector<double>& c, const std::vector<double>& k);

  [[nodiscard]] bool empty() const { return size_ == 0; }
  /// r -= C v + K u
  void subtract(const double* v, const double* u, double* r) const;

 private:
  std::size_t size_ = 0, width_ = 0;
  std::vector<double> values_;  // blocks of four rows, by diagonals: four entries of c, then four of k
};

struct SystemMatrices {
  explicit SystemMatrices(const Model& model);

  int size = 0;
  std::vector<std::int64_t> column_start;
  std::vector<int> row;
  std::vector<double> m, c, k;  ///< values of M, C and K, aligned with `row`

  /// r += M a + C v + K u
  void add_product(const double* a, const double* v, const double* u, double* r) const;
  /// r -= C v + K u
  void subtract_forces(const double* v, const double* u, double* r) const;
  /// v^T C v, the power dissipated by C, computed from the nonzero entries of one triangle.
  [[nodiscard]] double damping_power(const double* v) const;
  /// x^T A x, where `values` are the entries of A: one of m, c, k.
  [[nodiscard]] double quadratic(const std::vector<double>& values, const double* x) const;
  /// Sum of the magnitudes of all terms of quadratic(); the rounding error of quadratic() is relative to this sum.
  [[nodiscard]] double magnitude(const std::vector<double>& values, const double* x) const;
  /// r += A x, where `values` are the entries of A: one of m, c, k.
  void add_product(const std::vector<double>& values, const double* x, double* r) const;

 private:
  /// The part of a column of C + C' above the diagonal, for damping_power(); diagonal: c_jj.
  struct HalfColumn {
    int column = 0, end = 0;  // end: end of the column's entries in upper_row_
    double diagonal = 0.0;
  };
  BandedForces banded_;
  std::vector<HalfColumn> half_;
  std::vector<int> upper_row_;
  std::vector<double> upper_value_;  // c_ij + c_ji, i < j
};

// Sum of inertia, damping and elastic forces, in one pass over the entries.
//
//   r = M a + C v + K u = M (a + alpha v) + K (u + beta v) + R v,   C = alpha M + beta K + R
//
// R contains the discrete dampers and is mostly zero, so an entry of the pattern needs two numbers instead of three. The
// product is computed row by row, so each sum stays in a register. n degrees of freedom; unit of r: force.
//
//   for (i) product.put(i, a[i], v[i], u[i]);
//   product.apply(r);

class StructuralForces {
 public:
  StructuralForces(const Model& model, const SystemMatrices& structure);

  /// Sets the motion of degree of freedom i.
  void put(std::size_t i, double a, double v, double u) {
    x_[2 * i] = a + alpha_ * v;
    x_[2 * i + 1] = u + beta_ * v;
    if (!rest_.empty()) v_[i] = v;
  }
  /// r[0 .. n) := M a + C v + K u
  void apply(double* r) const;

 private:
  struct Entry {
    std::size_t row, column;
    double value;
  };
  double alpha_, beta_;
  std::vector<int> row_start_, column_;
  std::vector<double> values_;  // (M, K) of each entry, row by row
  std::vector<Entry> rest_;     // entries of R
  std::vector<double> x_, v_;   // x_: pairs (a + alpha v, u + beta v), one per column; v_: v
};

}  // namespace signorini::linear
