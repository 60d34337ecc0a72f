// band_factors.hpp: LU factors of a band matrix, without row exchanges.
//
//   A = L U,   a_ij = 0 for |i - j| > width
//
// A row of the factors depends only on its row of A and on the `width` rows of the factors before it. So elimination can be
// continued from any row. If rows of A change, all rows of the factors after `width` consecutive unchanged ones are unchanged.
//
// Intended for nearly symmetric, positive definite matrices: elimination needs no row exchanges, because sum_k |l_ik u_ki| is
// about a_ii. The ratio of this sum to a_ii bounds the growth of rounding errors. If the growth costs more than three digits,
// factor() fails, and a method with row exchanges is needed. The ratio does not depend on the units of the unknowns.
#pragma once

#include <cstddef>
#include <vector>

namespace signorini::linear {

class BandFactors {
 public:
  /// Makes a zero matrix, which the caller fills row by row with row().
  BandFactors(std::size_t size, std::size_t width);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t width() const { return width_; }
  /// Number of doubles between the starts of consecutive rows.
  [[nodiscard]] std::size_t stride() const { return stride_; }
  /// Row i, which the caller fills: a_ij at index width() + j - i for |i - j| <= width(). All other numbers must stay zero.
  [[nodiscard]] double* row(std::size_t i) { return values_.data() + i * stride_; }
  /// Sets all entries of rows [begin, end) to zero.
  void clear(std::size_t begin, std::size_t end);
  /// Factors all rows. False: A is singular, or factoring loses too many digits; the content of the object is then undefined.
  [[nodiscard]] bool factor() { return factor(0, size_); }
  /// Factors rows [begin, end) after the rows before `begin`. The result is bitwise the same as from factoring all rows at
  /// once.
  [[nodiscard]] bool factor(std::size_t begin, std::size_t end);
  /// b := A^-1 b
  void solve(double* b) const;

 private:
  std::size_t size_, width_, stride_;
  // Entries row after row, each row from column i - width on. After factor(): L below, U on and above the diagonal.
  std::vector<double> values_;
  std::vector<double> inverse_pivot_;
  std::vector<double> diagonal_, sums_;  // a_ii, and the sums of |l_ik u_ki|
};

}  // namespace signorini::linear
