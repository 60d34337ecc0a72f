// triangular_factors.hpp: KLU's factors packed for many solves.
//
//   R \ (P A Q) = L U + F       block upper triangular: L, U on the diagonal blocks, F above them
//   U = D U',  u'_ii = 1        pivots are reciprocals, and no product with them stands between two columns
//
// KLU keeps 16 bytes an entry, divides by pivots and scales, and goes through columns in the order of
// elimination, where most wait for the one before. Here are 12 bytes, and columns that do not depend on each
// other come in turn. An IDA step is one solve, a step of the series thirty: they outnumber factorisations.
#pragma once

#include <klu.h>

#include <vector>

namespace signorini {

class TriangularFactors {
 public:
  /// Takes over what KLU has factored. pattern: also the indices, after a factorisation with fresh pivots.
  void take(klu_l_symbolic* symbolic, klu_l_numeric* numeric, klu_l_common* common, bool pattern);
  /// b := A^-1 b
  void solve(double* b);

 private:
  /// As KLU hands them out.
  struct Raw {
    std::vector<SuiteSparse_long> start, row;
    std::vector<double> value;
    [[nodiscard]] std::size_t begin(std::size_t k) const { return static_cast<std::size_t>(start[k]); }
    void resize(std::size_t columns, SuiteSparse_long entries);
  };
  /// Columns in the order in which a sweep takes them.
  struct Columns {
    std::vector<int> column, end, row;
    std::vector<double> value;
    std::vector<std::size_t> from;  // place of each value in Raw
  };
  static void order(const Raw& raw, const std::vector<SuiteSparse_long>& blocks, bool lower, Columns& c);
  static void arrange(const std::vector<int>& level, const std::vector<SuiteSparse_long>& blocks,
                      bool backwards, std::vector<int>& columns);
  static void sweep(const Columns& c, std::size_t begin, std::size_t end, double* x);

  Raw raw_lower_, raw_upper_, raw_off_;
  Columns lower_, upper_, off_;
  std::vector<SuiteSparse_long> rows_long_, columns_long_, blocks_;
  std::vector<int> rows_, columns_;
  std::vector<double> scale_, inverse_scale_, inverse_pivot_, x_;
};

}  // namespace signorini
