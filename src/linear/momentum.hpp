// momentum.hpp: inertia, damping and elastic forces, one pass over the entries.
//
//   r = M a + C v + K u = M (a + alpha v) + K (u + beta v) + R v,   C = alpha M + beta K + R
//
// R holds what discrete dampers add, mostly nothing, so an entry costs two numbers instead of three. Rows,
// not columns: every sum stays in a register. Shapes: n degrees of freedom; unit of r: force.
//
//   for (i) product.put(i, a[i], v[i], u[i]);
//   product.apply(r);
//
// A narrow band, as a line of members has it, is taken four rows at a time, diagonal by diagonal, with the zeros
// in it: each row's sums are those of its entries in the same order, so the bits are those of rows.
#pragma once

#include <vector>

#include "linear/structure.hpp"

namespace signorini {

class Momentum {
 public:
  Momentum(const Model& model, const Structure& structure);

  /// The motion of degree of freedom i.
  void put(std::size_t i, double a, double v, double u) {
    x_[for_m_ + stride_ * i] = a + alpha_ * v;
    x_[for_k_ + stride_ * i] = u + beta_ * v;
    if (!rest_.empty()) v_[i] = v;
  }
  /// That of all.
  void put(const double* a, const double* v, const double* u);
  /// r[0 .. n) := M a + C v + K u
  void apply(double* r) const;

 private:
  struct Entry {
    std::size_t row, column;
    double value;
  };
  void make_band(const Structure& structure);
  void apply_rows(double* r) const;

  double alpha_, beta_;
  std::size_t size_;
  std::vector<int> row_start_, column_;
  std::vector<double> values_;  // (M, K) of each entry, row by row
  std::vector<Entry> rest_;     // R
  std::size_t reach_ = 0;       // of a band, to either side
  std::vector<double> band_;    // four rows of M, four of K for each diagonal, of each four rows; or none
  std::vector<double> x_, v_;   // what the rows are multiplied with; that of column i for M and K:
  std::size_t for_m_ = 0, for_k_ = 1, stride_ = 2;  // x_[for_m_ + stride_ i], x_[for_k_ + stride_ i]
};

}  // namespace signorini
