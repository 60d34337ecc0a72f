// damped_pencil.hpp: the matrix T(l) of damped_modes.hpp and its roots; and the band matrix K - s M.
//
//   T(l) (lambda, x_G) = 0,   l <- l - d^T T c / d^T T' c      Newton step with approximate null vectors d, c of T
//
// Terms are scaled: springs by sqrt(k), constraints to length 1. Modes with equal poles are rotated so that as few as possible
// are coupled to terms. A mode is in G if its pole is near l; all other modes contribute to the sums in T.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "engine/exact/modal/damped_modes.hpp"
#include "engine/exact/modal/small_matrices.hpp"
#include "signorini/model.hpp"

namespace signorini::modal {

// K - s M as a band matrix, factorised for any shift s.
//
//   P (K - s M) P^T = L D L^T,   negative pivots in D = number of omega_i^2 < s   (Sylvester)
//
// P orders the degrees of freedom so that the band is narrow (reverse Cuthill-McKee). The number type R is double for counting
// frequencies, and long double for computing frequencies, because the rounding error of a low frequency grows with the highest
// frequency.

/// Position of each degree of freedom in an order in which both matrices have a narrow band.
[[nodiscard]] std::vector<int> narrow_order(const SparseMatrix& mass, const SparseMatrix& stiffness);

template <class R>
class BandPencil {
 public:
  /// mass, stiffness: n x n, symmetric, both triangles stored; place: result of narrow_order().
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

  /// Factorises K - s M. Returns the number of negative pivots.
  std::size_t factor(R s) {
    const std::size_t rows = width_ + 1;
    for (std::size_t p = 0; p < factor_.size(); ++p) factor_[p] = k_[p] - s * m_[p];
    std::size_t negative = 0;
    for (std::size_t j = 0; j < n_; ++j) {
      R* column = factor_.data() + j * rows;
      // Within rounding, a zero pivot may have either sign. A tiny positive pivot replaces it.
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

  /// Solves x := (K - s M)^-1 x with the last factors.
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

/// Limit below which a pivot of T is regarded as zero, relative to the greatest pivot or 1, whichever is larger; chosen.
inline constexpr long double singular_pencil = 1e-10L;

class DampedPencil {
 public:
  using Index = Eigen::Index;
  using Long = long double;
  using Wide = WideComplex;

  /// T at one l, its derivative dT/dl, and the modes in G.
  struct Local {
    SmallMatrix<Wide> t{}, slope{};
    std::vector<Index> near;
    Long unit = 1;  ///< x_G is in units of 1 / unit
    std::vector<Wide> kappa;
    std::vector<Long> scale;  ///< one per term: lambda is in units of 1 / scale
    std::size_t size = 0;
  };

  /// Arguments as for damped_modes().
  DampedPencil(const Eigen::VectorXd& square, const Eigen::VectorXd& decay,
               const std::vector<ModalTerm>& terms);

  [[nodiscard]] Index size() const { return omega_squared_.size(); }
  [[nodiscard]] std::size_t rank() const { return terms_.size(); }
  [[nodiscard]] const Eigen::VectorXd& omega_squared() const { return omega_squared_; }
  [[nodiscard]] const Eigen::VectorXd& decay() const { return decay_; }
  /// Rotated and scaled terms, with kappa = stiffness() + l damping(). lambda of a scaled term is lambda of the given term
  /// divided by scale().
  [[nodiscard]] const std::vector<ModalTerm>& terms() const { return terms_; }
  [[nodiscard]] double stiffness(std::size_t term) const { return stiffness_[term]; }
  [[nodiscard]] double damping(std::size_t term) const { return damping_[term]; }
  [[nodiscard]] double scale(std::size_t term) const { return term_scale_[term]; }
  /// Modes that are coupled to at least one term. uncoupled_modes(): all other modes.
  [[nodiscard]] const std::vector<Index>& coupled_modes() const { return coupled_; }
  [[nodiscard]] const std::vector<Index>& uncoupled_modes() const { return uncoupled_; }
  /// First index of each group of equal poles and the rotation R of its modes: q_given = R q_rotated.
  [[nodiscard]] const std::vector<std::pair<Index, Eigen::MatrixXd>>& rotations() const { return rotations_; }

  /// P_j(l), see damped_modes.hpp.
  [[nodiscard]] Wide pole(Index j, Wide l) const { return l * l + l * decay_[j] + Wide(omega_squared_[j]); }
  /// Approximate roots of the coupled modes in double precision: eigenvalues of  x' = (0 1; -K -C) x  in the null space of the
  /// constraints.
  [[nodiscard]] Eigen::VectorXcd starting_roots() const;
  /// Computes T(l) and its derivative. False: too many modes are in G.
  [[nodiscard]] bool assemble_at(Wide l, Local& local) const;
  /// Refines a root by Newton steps. nullopt: no convergence.
  [[nodiscard]] std::optional<Wide> refined_root(Wide l) const;

 private:
  void rotate_equal_poles();
  void add_far(Index j, Wide l, Local& local) const;

  Eigen::VectorXd omega_squared_, decay_;
  std::vector<ModalTerm> terms_;
  std::vector<double> term_scale_, stiffness_, damping_;
  std::vector<std::pair<Index, Eigen::MatrixXd>> rotations_;
  std::vector<Index> coupled_, uncoupled_;
  Long reference_omega_ = 1;  // reference frequency for slow roots
};

}  // namespace signorini::modal
