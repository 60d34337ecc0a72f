// momentum.hpp: inertia, damping and elastic forces, one pass over the entries.
//
//   r = M a + C v + K u = M (a + alpha v) + K (u + beta v) + R v,   C = alpha M + beta K + R
//
// R contains discrete dampers and is mostly zero, so an entry costs two numbers instead of three. Rows instead of
// columns: every sum stays in a register. Shapes: n degrees of freedom; unit of r: force.
//
//   for (i) product.put(i, a[i], v[i], u[i]);
//   product.apply(r);
#pragma once

#include <vector>

#include "linear/structure.hpp"

namespace signorini {

class Momentum {
 public:
  Momentum(const Model& model, const Structure& structure);

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
  std::vector<Entry> rest_;     // R
  std::vector<double> x_, v_;   // factors of the rows, (for M, for K) of each column
};

}  // namespace signorini
