// factor_reader.hpp: reads the factors computed by KLU.
//
//   FactorReader reader;  reader.read(symbolic, numeric, common, true, factors);   after klu_l_factor
//                         reader.read(symbolic, numeric, common, false, factors);  after klu_l_refactor
//
// A factorisation with kept pivots changes values only: the reader remembers their places.
#pragma once

#include <klu.h>

#include "linear/triangular_factors.hpp"

namespace signorini {

class FactorReader {
 public:
  /// pattern: also the indices, after a factorisation with fresh pivots. Errors: runtime_error.
  void read(klu_l_symbolic* symbolic, klu_l_numeric* numeric, klu_l_common* common, bool pattern,
            TriangularFactors& factors);

 private:
  using Columns = TriangularFactors::Columns;
  using Long = SuiteSparse_long;
  /// Factors in KLU's own format.
  struct Raw {
    std::vector<Long> start, row;
    std::vector<double> value;
    std::vector<std::size_t> from;  // place in this object of each value of the packed columns
    [[nodiscard]] std::size_t begin(std::size_t k) const { return static_cast<std::size_t>(start[k]); }
    void resize(std::size_t columns, Long entries);
  };
  void make_room(const klu_l_symbolic& symbolic, const klu_l_numeric& numeric);
  void read_pattern(TriangularFactors& factors);
  void order(Raw& raw, bool lower, Columns& c) const;
  void arrange(const std::vector<int>& level, bool backwards, std::vector<int>& columns) const;

  Raw lower_, upper_, off_;
  std::vector<Long> rows_, columns_, blocks_;
  std::vector<double> scale_;
};

}  // namespace signorini
