// banded_forces.hpp: forces of a structure with narrow band matrices, four equations at once.
//
//   r_i -= sum_j ( c_ij v_j + k_ij u_j ),   j from i - width to i + width
//
// Column by column each sum would wait until the previous one is stored. Here four rows are processed in parallel,
// diagonal by diagonal. Each row adds its terms in the order of the columns, and missing entries add zero: the results
// are bitwise the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace signorini {

class BandedForces {
 public:
  BandedForces() = default;
  /// Empty if bands would have far more places than entries. Compressed columns; c, k: aligned with `row`.
  BandedForces(const std::vector<std::int64_t>& column_start, const std::vector<int>& row,
               const std::vector<double>& c, const std::vector<double>& k);

  [[nodiscard]] bool empty() const { return size_ == 0; }
  /// r -= C v + K u
  void subtract(const double* v, const double* u, double* r) const;

 private:
  std::size_t size_ = 0, width_ = 0;
  std::vector<double> values_;  // four rows, diagonal by diagonal: c of each, k of each
};

}  // namespace signorini
