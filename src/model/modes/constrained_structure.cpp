#include "model/modes/constrained_structure.hpp"

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "model/assembly/parts.hpp"
#include "model/statics/static_system.hpp"

namespace signorini::modes {
namespace {

// Eigenvalues of T^T K^-1 T below this fraction of the largest one belong to motions that other contacts already fix.
constexpr double fixed_twice = 1e-12;

}  // namespace

Eigen::MatrixXd form_columns(const std::vector<Combination>& forms, int n) {
  Eigen::MatrixXd t(n, static_cast<Eigen::Index>(forms.size()));
  for (std::size_t j = 0; j < forms.size(); ++j)
    t.col(static_cast<Eigen::Index>(j)) = assembly::dense_vector(forms[j], n);
  return t;
}

SparseMatrix restricted(const SparseMatrix& a, const Eigen::MatrixXd& q) {
  Eigen::MatrixXd result = q.transpose() * (a * q);
  const Eigen::MatrixXd across = q.cwiseAbs();
  const Eigen::MatrixXd size = across.transpose() * (SparseMatrix(a.cwiseAbs()) * across);
  result = (result.array().abs() > rounding::many_operations * size.array()).select(result, 0.0);
  return result.sparseView();
}

SparseMatrix with_constraint_springs(const SparseMatrix& k, const std::vector<Combination>& forms) {
  std::vector<assembly::LineSpring> springs;
  for (const Combination& form : forms) springs.push_back({form, statics::structural_stiffness(k, form)});
  return assembly::with_springs(k, springs);
}

ConstrainedStructure::ConstrainedStructure(const SparseMatrix& k, const std::vector<Combination>& fixed)
    : solver_(with_constraint_springs(k, fixed)) {
  if (fixed.empty()) return;
  for (const assembly::Part& part : assembly::Parts({&k}, fixed)) {
    const std::vector<Combination> own = part.forms(fixed);
    if (own.empty()) continue;
    ConstraintBlock block{part.dofs(), form_columns(own, part.size()), {}};
    Eigen::MatrixXd kt(block.t.rows(), block.t.cols());
    for (Eigen::Index j = 0; j < kt.cols(); ++j) {
      Vector force = Vector::Zero(k.rows());
      force(block.dofs) = block.t.col(j);
      kt.col(j) = solver_.solve(force)(block.dofs);
    }
    // Several contacts may fix the same motion; the pseudo-inverse ignores the redundant constraints.
    const base::EigenPairs g = base::symmetric_eigen(block.t.transpose() * kt);
    Eigen::VectorXd inverse = g.values;
    const double greatest = inverse[inverse.size() - 1];
    for (double& value : inverse) value = value > fixed_twice * greatest ? 1.0 / value : 0.0;
    block.correction = kt * g.vectors * inverse.asDiagonal() * g.vectors.transpose();
    constraint_blocks_.push_back(std::move(block));
  }
}

Vector ConstrainedStructure::solve(const Vector& b) const {
  Vector u = solver_.solve(b);
  for (const ConstraintBlock& block : constraint_blocks_) {
    const Vector own = u(block.dofs);
    u(block.dofs) = own - block.correction * (block.t.transpose() * own);
  }
  return u;
}

}  // namespace signorini::modes
