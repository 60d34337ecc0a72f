// band_factors.hpp: L and U of a band matrix, without exchanges of rows.
//
//   A = L U,   a_ij = 0 for |i - j| > width
//
// A row depends on the `width` rows before it: factors of some rows can be continued from those, and if as many
// consecutive rows are unchanged, so are all that follow.
//
// A row of the factors depends on the `width` rows before it. So elimination can be continued from any row,
// and once `width` consecutive rows are unchanged, all later ones are.
//
// For nearly symmetric, positive matrices: their elimination needs no row exchanges, since sum_k |l_ik u_ki|
// is a_ii. The ratio of that sum to a_ii bounds the growth of rounding errors. If it exceeds three digits,
// factor() fails, and a method with exchanges is needed. No test depends on units: a row and its column may
// be scaled.
#pragma once

#include <cstddef>
#include <vector>

namespace signorini::linear {

class BandFactors {
 public:
  /// A zero matrix, to be filled row by row.
  BandFactors(std::size_t size, std::size_t width);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t width() const { return width_; }
  /// Numbers from one row to the next.
  [[nodiscard]] std::size_t stride() const { return stride_; }
  /// Row i, to be filled: a_ij at width() + j - i, |i - j| <= width; zeros elsewhere.
  [[nodiscard]] double* row(std::size_t i) { return values_.data() + i * stride_; }
  /// Sets all entries of rows [begin, end) to zero.
  void clear(std::size_t begin, std::size_t end);
  /// Factors all rows. False: A is singular or factoring loses too many digits; the content is then
  /// undefined.
  [[nodiscard]] bool factor() { return factor(0, size_); }
  /// Factors rows [begin, end), after the rows before: bitwise the same as factoring all rows at once.
  [[nodiscard]] bool factor(std::size_t begin, std::size_t end);
  /// b := A^-1 b
  void solve(double* b) const;

 private:
  std::size_t size_, width_, stride_;
  // Row after row, from column i - width on; once factored, L below and U above the diagonal.
  std::vector<double> values_;
  std::vector<double> inverse_pivot_;
  std::vector<double> diagonal_, sums_;  // a_ii and the sums above
};

}  // namespace signorini::linear
