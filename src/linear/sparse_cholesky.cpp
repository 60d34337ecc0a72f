#include "linear/sparse_cholesky.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <limits>

namespace signorini::linear {

struct SymmetricSolver::Impl {
  Eigen::SimplicialLDLT<SparseMatrix> ldlt;
  Vector diagonal;
};

SymmetricSolver::SymmetricSolver(const SparseMatrix& k) : impl_(std::make_unique<Impl>()) {
  impl_->ldlt.compute(k);
  impl_->diagonal = k.diagonal();
}
SymmetricSolver::~SymmetricSolver() = default;
SymmetricSolver::SymmetricSolver(SymmetricSolver&&) noexcept = default;
SymmetricSolver& SymmetricSolver::operator=(SymmetricSolver&&) noexcept = default;
bool SymmetricSolver::ok() const { return impl_->ldlt.info() == Eigen::Success; }
Vector SymmetricSolver::solve(const Vector& b) const { return impl_->ldlt.solve(b); }
double SymmetricSolver::smallest_pivot() const {
  return impl_->ldlt.vectorD().size() == 0 ? 0.0 : impl_->ldlt.vectorD().minCoeff();
}

double SymmetricSolver::smallest_pivot_ratio() const {
  const Vector pivots = impl_->ldlt.permutationPinv() * impl_->ldlt.vectorD();
  double least = pivots.size() == 0 ? 0.0 : std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < pivots.size(); ++i)
    least = std::min(least, impl_->diagonal[i] > 0.0 ? pivots[i] / impl_->diagonal[i] : 0.0);
  return least;
}

int SymmetricSolver::negative_pivots() const {
  return static_cast<int>((impl_->ldlt.vectorD().array() < 0.0).count());
}

// Eigen factors P A P^T = L L^T, so that F = P^T L.
struct CholeskyFactor::Impl {
  Eigen::SimplicialLLT<SparseMatrix> llt;
};

CholeskyFactor::CholeskyFactor(const SparseMatrix& a) : impl_(std::make_unique<Impl>()) {
  impl_->llt.compute(a);
}
CholeskyFactor::~CholeskyFactor() = default;
bool CholeskyFactor::ok() const { return impl_->llt.info() == Eigen::Success; }
Vector CholeskyFactor::times(const Vector& x) const {
  const Vector y = impl_->llt.matrixL() * x;
  return impl_->llt.permutationPinv() * y;
}
Vector CholeskyFactor::solve_factor(const Vector& x) const {
  const Vector y = impl_->llt.permutationP() * x;
  return impl_->llt.matrixL().solve(y);
}
Vector CholeskyFactor::solve_transposed_factor(const Vector& x) const {
  const Vector y = impl_->llt.matrixU().solve(x);
  return impl_->llt.permutationPinv() * y;
}

}  // namespace signorini::linear
