#include "model/statics/loose_motions.hpp"

#include <cmath>

#include "base/eigen_dense.hpp"
#include "model/statics/null_motions.hpp"

namespace signorini {

LooseMotions::LooseMotions(const SparseMatrix& k, const std::vector<HeldRow>& rows,
                           const std::vector<bool>& loose) {
  std::vector<LineSpring> stay;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (loose[i])
      rows_.push_back(i);
    else
      stay.push_back({rows[i].form, rows[i].stiffness});
  if (rows_.empty()) return;
  const SparseMatrix rest = with_springs(k, stay);
  if (may_have_null_motions(rest)) motions_ = null_motions(rest);
  if (motions_.cols() == 0) return;
  root_.resize(static_cast<Eigen::Index>(rows_.size()));
  moves_.resize(root_.size(), motions_.cols());
  for (Eigen::Index i = 0; i < root_.size(); ++i) {
    const HeldRow& row = rows[rows_[static_cast<std::size_t>(i)]];
    root_[i] = std::sqrt(row.stiffness);
    for (Eigen::Index j = 0; j < motions_.cols(); ++j)
      moves_(i, j) = root_[i] * row.form.dot(motions_.col(j));
  }
  q_ = orthonormal(moves_);
}

std::pair<Vector, Vector> LooseMotions::answer(const HeldRows& held, std::size_t row, double r) const {
  Vector slips = Vector::Zero(static_cast<Eigen::Index>(held.size()));
  slips[static_cast<Eigen::Index>(row)] = r;
  const Vector none = Vector::Zero(held.matrix().rows());
  if (motions_.cols() == 0) return held.solve(none, slips);
  Eigen::VectorXd own(root_.size());
  for (Eigen::Index i = 0; i < own.size(); ++i)
    own[i] = rows_[static_cast<std::size_t>(i)] == row ? root_[i] * r : 0.0;
  const Eigen::VectorXd free = along(own), resisted = own - free;
  for (Eigen::Index i = 0; i < own.size(); ++i)
    slips[static_cast<Eigen::Index>(rows_[static_cast<std::size_t>(i)])] = resisted[i] / root_[i];
  auto [u, forces] = held.solve(none, slips);
  for (Eigen::Index i = 0; i < own.size(); ++i)
    own[i] = forces[static_cast<Eigen::Index>(rows_[static_cast<std::size_t>(i)])] / root_[i];
  own -= along(own);
  for (Eigen::Index i = 0; i < own.size(); ++i)
    forces[static_cast<Eigen::Index>(rows_[static_cast<std::size_t>(i)])] = root_[i] * own[i];
  u += motions_ * least_squares(moves_, free);
  return {std::move(u), std::move(forces)};
}

}  // namespace signorini
