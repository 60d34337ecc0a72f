#include "model/modes/held.hpp"

#include "base/eigen_dense.hpp"
#include "model/statics/static_system.hpp"

namespace signorini {

Eigen::MatrixXd form_columns(const std::vector<Combination>& forms, int n) {
  Eigen::MatrixXd t(n, static_cast<Eigen::Index>(forms.size()));
  for (std::size_t j = 0; j < forms.size(); ++j) t.col(static_cast<Eigen::Index>(j)) = full(forms[j], n);
  return t;
}

SparseMatrix with_grips(const SparseMatrix& k, const std::vector<Combination>& forms) {
  std::vector<LineSpring> springs;
  for (const Combination& form : forms) springs.push_back({form, own_stiffness(k, form)});
  return with_springs(k, springs);
}

HeldStructure::HeldStructure(const SparseMatrix& k, const std::vector<Combination>& fixed)
    : solver_(with_grips(k, fixed)), t_(form_columns(fixed, static_cast<int>(k.rows()))) {
  if (t_.cols() == 0) return;
  Eigen::MatrixXd kt(t_.rows(), t_.cols());
  for (Eigen::Index j = 0; j < t_.cols(); ++j) kt.col(j) = solver_.solve(t_.col(j));
  // Two contacts may fix the same motion: the pseudo-inverse counts it once.
  const EigenPairs g = symmetric_eigen(t_.transpose() * kt);
  Eigen::VectorXd inverse = g.values;
  const double greatest = inverse[inverse.size() - 1];
  for (double& value : inverse) value = value > 1e-12 * greatest ? 1.0 / value : 0.0;
  correction_ = kt * g.vectors * inverse.asDiagonal() * g.vectors.transpose();
}

Vector HeldStructure::solve(const Vector& b) const {
  Vector u = solver_.solve(b);
  if (t_.cols() > 0) u -= correction_ * (t_.transpose() * u);
  return u;
}

}  // namespace signorini
