// triangular_factors.hpp: KLU's factors packed for many solves.
//
//   R \ (P A Q) = L U + F       block upper triangular: L, U on the diagonal blocks, F above them
//   U = D U',  u'_ii = 1        pivots are stored as reciprocals, applied once, not between columns
//
// KLU uses 16 bytes for each entry, divides by pivots and scales, and processes columns in the order of elimination,
// where most wait for the previous one. This format uses 12 bytes, and places independent columns next to each other.
// An IDA step takes one solve, a step of the series thirty: solves outnumber factorisations.
#pragma once

#include <cstddef>
#include <vector>

namespace signorini {

class TriangularFactors {
 public:
  /// b := A^-1 b; both of length size(), work: scratch.
  void solve(double* b, double* work) const;
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  /// Memory in use.
  [[nodiscard]] std::size_t bytes() const;

 private:
  friend class FactorReader;  // linear/factor_reader.hpp makes them
  /// Entries column after column; those of the i-th column end at end[i].
  struct Columns {
    std::vector<int> column, end, row;  // column: in the order of a sweep
    std::vector<double> value;
    [[nodiscard]] std::size_t bytes() const;
  };
  static void sweep(const Columns& c, std::size_t begin, std::size_t end, double* x);

  Columns lower_, upper_, off_;
  std::vector<int> rows_, columns_, blocks_;  // permutations; beginnings of blocks
  std::vector<double> inverse_scale_, inverse_pivot_;
};

}  // namespace signorini
