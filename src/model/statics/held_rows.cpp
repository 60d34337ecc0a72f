#include "model/statics/held_rows.hpp"

#include <algorithm>

#include "base/eigen_dense.hpp"
#include "contact/form_columns.hpp"
#include "model/statics/null_motions.hpp"

namespace signorini {
namespace {

/// Rounding leaves a pivot of some eps of its diagonal entry; below this value null motions are searched for.
constexpr double regular_share = 1e-9;
// Relative remainder of a row after removing other rows that span it; rounding is below. Chosen value.
constexpr double spanned = 1e-9;

}  // namespace

bool held_besides(const std::vector<HeldRow>& rows, const std::vector<bool>& loose, std::size_t row) {
  std::vector<const Combination*> forms{&rows[row].form};
  for (std::size_t j = 0; j < rows.size(); ++j)
    if (j != row && rows[j].rigid && !loose[j]) forms.push_back(&rows[j].form);
  if (!rows[row].rigid || forms.size() < 2) return false;
  const Eigen::MatrixXd columns = form_columns(forms);
  const Eigen::MatrixXd others = columns.rightCols(columns.cols() - 1);
  const Eigen::VectorXd own = columns.col(0);
  return (own - others * least_squares(others, own)).norm() <= spanned * own.norm();
}

HeldRows::HeldRows(const SparseMatrix& k, std::vector<HeldRow> rows)
    : rows_(std::move(rows)),
      matrix_(with_springs(k, springs())),
      solver_(matrix_),
      regular_(solver_.ok() &&
               (solver_.smallest_share() > regular_share || null_motions(matrix_).cols() == 0)) {
  for (std::size_t j = 0; j < rows_.size(); ++j)
    if (rows_[j].rigid) rigid_.push_back(j);
  if (!regular()) return;
  const auto n = static_cast<Eigen::Index>(rigid_.size());
  schur_.resize(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    answers_.push_back(solver_.solve(full(rigid_row(i).form, static_cast<int>(k.rows()))));
    for (Eigen::Index j = 0; j < n; ++j) schur_(j, i) = rigid_row(j).form.dot(answers_.back());
  }
}

std::pair<Vector, Vector> HeldRows::solve(Vector load, const Vector& r) const {
  for (std::size_t j = 0; j < rows_.size(); ++j)
    if (const double by = r[static_cast<Eigen::Index>(j)]; by != 0.0)
      rows_[j].form.add_to(load, rows_[j].stiffness * by);
  Vector u = solver_.solve(load);
  Vector forces = Vector::Zero(r.size());
  const auto n = static_cast<Eigen::Index>(rigid_.size());
  if (n > 0) {
    Eigen::VectorXd miss(n);
    for (Eigen::Index i = 0; i < n; ++i)
      miss[i] = rigid_row(i).form.dot(u) - r[static_cast<Eigen::Index>(rigid_[static_cast<std::size_t>(i)])];
    // Rows that fix the same motion share its force: the least-norm solution.
    const Eigen::VectorXd multipliers = least_squares(schur_, miss);
    for (Eigen::Index i = 0; i < n; ++i) {
      u -= multipliers[i] * answers_[static_cast<std::size_t>(i)];
      forces[static_cast<Eigen::Index>(rigid_[static_cast<std::size_t>(i)])] = multipliers[i];
    }
  }
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    forces[i] += rows_[j].rigid ? 0.0 : rows_[j].stiffness * (rows_[j].form.dot(u) - r[i]);
  }
  return {std::move(u), std::move(forces)};
}

std::vector<LineSpring> HeldRows::springs() const {
  std::vector<LineSpring> list;
  for (const HeldRow& row : rows_) list.push_back({row.form, row.stiffness});
  return list;
}

}  // namespace signorini
