// band_factors.hpp: L and U of a band matrix, without exchanges of rows.
//
//   A = L U,   a_ij = 0 for |i - j| > width
//
// For matrices that are symmetric and positive but for little: of such ones elimination needs no exchanges, for
// sum_k |l_ik u_ki| is a_ii. How far that sum exceeds a_ii is what rounding may have grown by; beyond three digits there
// are no factors, and a method with exchanges is due. No test depends on units: a row and its column may be scaled.
#pragma once

#include <cstddef>
#include <vector>

namespace signorini {

class BandFactors {
 public:
  BandFactors(std::size_t size, std::size_t width);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t width() const { return width_; }
  /// Where a_ij stands; |i - j| <= width.
  [[nodiscard]] std::size_t slot(std::size_t i, std::size_t j) const { return i * stride_ + width_ + j - i; }
  /// All entries zero, to be filled.
  void clear();
  [[nodiscard]] double& at(std::size_t slot) { return values_[slot]; }
  /// Of what stands there. False: it would lose more digits than it may, or is singular; then nothing is known.
  [[nodiscard]] bool factor();
  /// b := A^-1 b
  void solve(double* b) const;

 private:
  std::size_t size_, width_, stride_;
  std::vector<double>
      values_;  // row after row from column i - width on; later L below and U above the diagonal
  std::vector<double> inverse_pivot_;
  std::vector<double> diagonal_, sums_;  // a_ii and the sums above
};

}  // namespace signorini
