// sparse_cholesky.hpp: direct solution and inertia of symmetric sparse matrices.
//
//   A = P^T L D L^T P,    A x = b,    negative eigenvalues of A: those of D
//
// Shapes: A n x n, symmetric, both triangles stored; x and b of length n.
#pragma once

#include <memory>

#include "signorini/model.hpp"

namespace signorini::linear {

/// L D L^T of a symmetric sparse matrix, with a fill-reducing order.
class SymmetricSolver {
 public:
  explicit SymmetricSolver(const SparseMatrix& k);
  ~SymmetricSolver();
  SymmetricSolver(SymmetricSolver&&) noexcept;
  SymmetricSolver& operator=(SymmetricSolver&&) noexcept;

  /// False if a pivot is exactly zero.
  [[nodiscard]] bool ok() const;
  [[nodiscard]] Vector solve(const Vector& b) const;
  /// The smallest pivot; 0 without pivots.
  [[nodiscard]] double smallest_pivot() const;
  /// Smallest ratio of a pivot to its diagonal entry; independent of the units of the rows.
  [[nodiscard]] double smallest_pivot_ratio() const;
  /// Number of negative eigenvalues (Sylvester's law of inertia).
  [[nodiscard]] int negative_pivots() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A = F F^T of a symmetric positive definite sparse matrix, by L L^T in a fill-reducing order.
class CholeskyFactor {
 public:
  explicit CholeskyFactor(const SparseMatrix& a);
  ~CholeskyFactor();
  /// False if A is not positive definite.
  [[nodiscard]] bool ok() const;
  [[nodiscard]] Vector times(const Vector& x) const;                    ///< F x
  [[nodiscard]] Vector solve_factor(const Vector& x) const;             ///< F^-1 x
  [[nodiscard]] Vector solve_transposed_factor(const Vector& x) const;  ///< F^-T x

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace signorini::linear
