// small_matrices.hpp: L U factors of small matrices with complete pivoting, null vectors of singular matrices, and products of
// a large matrix with a few vectors.
//
//   P G Q = L U
#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "engine/exact/modal/complex_lanes.hpp"

namespace signorini::modal {

/// Largest size of a small matrix, and so the largest number of contact springs in a contact state of the modal flow.
inline constexpr std::size_t max_rank = 12;

template <class S>
using SmallMatrix = std::array<std::array<S, max_rank>, max_rank>;
template <class S>
using SmallVector = std::array<S, max_rank>;

template <class S>
class SmallLu {
 public:
  SmallLu(const SmallMatrix<S>& g, std::size_t rank) : rank_(rank), a_(g) {
    for (std::size_t i = 0; i < rank; ++i) row_[i] = column_[i] = i;
    for (std::size_t k = 0; k < rank; ++k) {
      std::size_t p = k, q = k;
      for (std::size_t i = k; i < rank; ++i)
        for (std::size_t j = k; j < rank; ++j)
          if (size_of(a_[i][j]) > size_of(a_[p][q])) {
            p = i;
            q = j;
          }
      std::swap(a_[k], a_[p]);
      std::swap(row_[k], row_[p]);
      for (std::size_t i = 0; i < rank; ++i) std::swap(a_[i][k], a_[i][q]);
      std::swap(column_[k], column_[q]);
      if (!(size_of(a_[k][k]) > 0.0)) {
        singular_ = true;
        return;
      }
      const S pivot = inverse(a_[k][k]);
      for (std::size_t i = k + 1; i < rank; ++i) {
        a_[i][k] = a_[i][k] * pivot;
        for (std::size_t j = k + 1; j < rank; ++j) a_[i][j] -= a_[i][k] * a_[k][j];
      }
    }
  }

  /// True if a pivot is exactly zero: no solve is possible.
  [[nodiscard]] bool singular() const { return singular_; }

  /// Returns tr(G^-1 B).
  template <class T>
  [[nodiscard]] S trace_of_solution(const SmallMatrix<T>& b) const {
    S trace{};
    for (std::size_t c = 0; c < rank_; ++c) {
      SmallVector<S> x{};
      for (std::size_t i = 0; i < rank_; ++i) {
        x[i] = b[row_[i]][c];
        for (std::size_t j = 0; j < i; ++j) x[i] -= a_[i][j] * x[j];
      }
      for (std::size_t i = rank_; i-- > 0;) {
        for (std::size_t j = i + 1; j < rank_; ++j) x[i] -= a_[i][j] * x[j];
        x[i] = x[i] * inverse(a_[i][i]);
        if (column_[i] == c) trace += x[i];
      }
    }
    return trace;
  }

  /// Returns G^-1 b.
  [[nodiscard]] SmallVector<S> solve(const SmallVector<S>& b) const {
    SmallVector<S> x{}, result{};
    for (std::size_t i = 0; i < rank_; ++i) {
      x[i] = b[row_[i]];
      for (std::size_t j = 0; j < i; ++j) x[i] -= a_[i][j] * x[j];
    }
    for (std::size_t i = rank_; i-- > 0;) {
      for (std::size_t j = i + 1; j < rank_; ++j) x[i] -= a_[i][j] * x[j];
      x[i] = x[i] * inverse(a_[i][i]);
      result[column_[i]] = x[i];
    }
    return result;
  }

  /// Returns G^-T b.
  [[nodiscard]] SmallVector<S> solve_transposed(const SmallVector<S>& b) const {
    SmallVector<S> x{}, result{};
    for (std::size_t i = 0; i < rank_; ++i) {
      x[i] = b[column_[i]];
      for (std::size_t j = 0; j < i; ++j) x[i] -= a_[j][i] * x[j];
      x[i] = x[i] * inverse(a_[i][i]);
    }
    for (std::size_t i = rank_; i-- > 0;) {
      for (std::size_t j = i + 1; j < rank_; ++j) x[i] -= a_[j][i] * x[j];
      result[row_[i]] = x[i];
    }
    return result;
  }

  /// Computes null vectors c, d with G c = 0 and d^T G = 0. The last `nullity` pivots are regarded as zero. which: index of the
  /// null vector, 0 to nullity - 1.
  void null_vectors(SmallVector<S>& c, SmallVector<S>& d, std::size_t nullity = 1,
                    std::size_t which = 0) const {
    SmallVector<S> x{}, w{};
    const std::size_t first = rank_ - nullity;
    x[first + which] = w[first + which] = S(1.0);
    for (std::size_t i = first; i-- > 0;) {
      S sum{}, left{};
      for (std::size_t j = i + 1; j < rank_; ++j) {
        sum += a_[i][j] * x[j];
        left += a_[j][i] * w[j];
      }
      x[i] = -(sum * inverse(a_[i][i]));
      w[i] = -left;
    }
    for (std::size_t i = 0; i < rank_; ++i) {
      c[column_[i]] = x[i];
      d[row_[i]] = w[i];
    }
  }

  /// Magnitude of pivot k. Complete pivoting makes the magnitudes decrease, except for small variations.
  [[nodiscard]] auto pivot(std::size_t k) const { return size_of(a_[k][k]); }

 private:
  std::size_t rank_;
  SmallMatrix<S> a_;
  std::array<std::size_t, max_rank> row_{}, column_{};
  bool singular_ = false;
};

// A large matrix times a few vectors, A x_1, A x_2, ..., in one pass through memory.
//
// Four rows and up to three vectors are processed at once, so that each loaded entry is used several times, and several
// additions run in parallel. Every sum is computed as four partial sums (entries k, k + 4, ...), so the result is identical in
// every build.

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Computes y[s] := a x[s] for all s. No y may be the same vector as an x.
void thin_product(const RowMatrix& a, const std::vector<const Eigen::VectorXd*>& x,
                  const std::vector<Eigen::VectorXd*>& y);

}  // namespace signorini::modal
