// band_pencil.hpp: K - s M as a band, factored for any shift.
//
//   P (K - s M) P^T = L D L^T,   negative pivots in D = number of omega_i^2 < s   (Sylvester)
//
// P orders the degrees of freedom so that the band is narrow (reverse Cuthill-McKee). R is double for counting and long
// double for accurate digits: the rounding error of a low frequency grows with the highest one.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "signorini/model.hpp"

namespace signorini {

/// Place of each degree of freedom in an order in which the band of both matrices is narrow.
[[nodiscard]] std::vector<int> narrow_order(const SparseMatrix& mass, const SparseMatrix& stiffness);

template <class R>
class BandPencil {
 public:
  /// mass, stiffness: n x n, symmetric, both triangles stored; place: a permutation.
  BandPencil(const SparseMatrix& mass, const SparseMatrix& stiffness, const std::vector<int>& place)
      : n_(place.size()) {
    for (const SparseMatrix* matrix : {&mass, &stiffness})
      for (int j = 0; j < matrix->outerSize(); ++j)
        for (SparseMatrix::InnerIterator it(*matrix, j); it; ++it)
          width_ = std::max(width_, static_cast<std::size_t>(std::abs(at(place, it.row()) - at(place, j))));
    m_.assign(n_ * (width_ + 1), R(0));
    k_ = m_;
    factor_ = m_;
    fill(mass, place, m_);
    fill(stiffness, place, k_);
  }

  [[nodiscard]] std::size_t size() const { return n_; }

  /// Factors K - s M; returns the number of negative pivots.
  std::size_t factor(R s) {
    const std::size_t rows = width_ + 1;
    for (std::size_t p = 0; p < factor_.size(); ++p) factor_[p] = k_[p] - s * m_[p];
    std::size_t negative = 0;
    for (std::size_t j = 0; j < n_; ++j) {
      R* column = factor_.data() + j * rows;
      // A zero pivot is one rounding away from either sign.
      if (column[0] == R(0))
        column[0] = std::numeric_limits<R>::epsilon() * (std::abs(k_[j * rows]) + R(1e-300L));
      if (column[0] < R(0)) ++negative;
      const std::size_t last = std::min(width_, n_ - 1 - j);
      const R inverse = R(1) / column[0];
      for (std::size_t i = 1; i <= last; ++i) {
        if (column[i] == R(0)) continue;
        const R l = column[i] * inverse;
        R* target = column + i * rows;
        for (std::size_t p = i; p <= last; ++p) target[p - i] -= l * column[p];
      }
      for (std::size_t i = 1; i <= last; ++i) column[i] *= inverse;
    }
    return negative;
  }

  /// x := (K - s M)^-1 x with the last factors.
  void solve(R* x) const {
    const std::size_t rows = width_ + 1;
    for (std::size_t j = 0; j < n_; ++j) {
      const R* column = factor_.data() + j * rows;
      const std::size_t last = std::min(width_, n_ - 1 - j);
      for (std::size_t i = 1; i <= last; ++i) x[j + i] -= column[i] * x[j];
    }
    for (std::size_t j = n_; j-- > 0;) {
      const R* column = factor_.data() + j * rows;
      const std::size_t last = std::min(width_, n_ - 1 - j);
      R sum = x[j] / column[0];
      for (std::size_t i = 1; i <= last; ++i) sum -= column[i] * x[j + i];
      x[j] = sum;
    }
  }

  void times_mass(const R* x, R* y) const { times(m_, x, y); }
  void times_stiffness(const R* x, R* y) const { times(k_, x, y); }

 private:
  static int at(const std::vector<int>& place, Eigen::Index i) { return place[static_cast<std::size_t>(i)]; }

  void fill(const SparseMatrix& matrix, const std::vector<int>& place, std::vector<R>& band) const {
    for (int j = 0; j < matrix.outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(matrix, j); it; ++it) {
        const int row = at(place, it.row()), column = at(place, j);
        if (row >= column)
          band[static_cast<std::size_t>(column) * (width_ + 1) + static_cast<std::size_t>(row - column)] =
              static_cast<R>(it.value());
      }
  }

  void times(const std::vector<R>& band, const R* x, R* y) const {
    const std::size_t rows = width_ + 1;
    for (std::size_t j = 0; j < n_; ++j) y[j] = R(0);
    for (std::size_t j = 0; j < n_; ++j) {
      const R* column = band.data() + j * rows;
      const std::size_t last = std::min(width_, n_ - 1 - j);
      R sum = column[0] * x[j];
      for (std::size_t i = 1; i <= last; ++i) {
        sum += column[i] * x[j + i];
        y[j + i] += column[i] * x[j];
      }
      y[j] += sum;
    }
  }

  std::size_t n_ = 0, width_ = 0;
  std::vector<R> m_, k_, factor_;  // columns of width + 1 entries, the diagonal first
};

}  // namespace signorini
