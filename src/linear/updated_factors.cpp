#include "linear/updated_factors.hpp"

#include <algorithm>

#include "base/eigen_dense.hpp"

namespace signorini {
namespace {

// Limit for the loss of digits by 1 + D Y: three, the same as for pivots kept for another length (linear/klu.cpp). Its
// inverse loses as many as its condition number; and if D Y is large, the rows in force are small differences of x and
// of Y times their shares.
constexpr double least_quality = 1e-3;
// Columns of Y that are kept, since rows recur.
constexpr std::size_t most_columns = 4 * UpdatedFactors::most_rows;

double dot(const ChangedRow& row, const double* x) {
  double sum = 0.0;
  for (const auto& [column, value] : row.entries) sum += value * x[column];
  return sum;
}

double norm(const Eigen::MatrixXd& a) { return a.cwiseAbs().rowwise().sum().maxCoeff(); }

}  // namespace

void UpdatedFactors::start(std::shared_ptr<const TriangularFactors> base) {
  base_ = std::move(base);
  columns_.clear();
  rows_.clear();
}

const Eigen::VectorXd& UpdatedFactors::column(std::size_t row) {
  const auto [place, fresh] = columns_.try_emplace(row);
  if (fresh) {
    place->second.setZero(static_cast<Eigen::Index>(base_->size()));
    place->second[static_cast<Eigen::Index>(row)] = 1.0;
    work_.resize(place->second.size());
    base_->solve(place->second.data(), work_.data());
    ++solves_;
  }
  return place->second;
}

bool UpdatedFactors::set(std::vector<ChangedRow> rows) {
  if (!base_ || rows.size() > most_rows) return false;
  if (columns_.size() + rows.size() > most_columns) columns_.clear();
  rows_ = std::move(rows);
  in_force_.clear();
  for (const ChangedRow& row : rows_) in_force_.push_back(&column(row.row));
  const auto m = static_cast<Eigen::Index>(rows_.size());
  Eigen::MatrixXd added(m, m);
  for (Eigen::Index i = 0; i < m; ++i)
    for (Eigen::Index j = 0; j < m; ++j)
      added(i, j) = dot(rows_[static_cast<std::size_t>(i)], in_force_[static_cast<std::size_t>(j)]->data());
  parts_.resize(m);
  shares_.resize(m);
  if (m == 0) return true;
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(m, m);
  inverse_ = solve_dense(one + added, one);
  const double size = 1.0 + norm(added);
  return least_quality * size * std::max(1.0, norm(inverse_)) <= 1.0;  // false for NaN
}

void UpdatedFactors::solve(double* b, double* work) {
  base_->solve(b, work);
  if (rows_.empty()) return;
  const auto m = static_cast<Eigen::Index>(rows_.size());
  for (Eigen::Index i = 0; i < m; ++i) parts_[i] = dot(rows_[static_cast<std::size_t>(i)], b);
  shares_.noalias() = inverse_ * parts_;
  Eigen::Map<Eigen::VectorXd> x(b, static_cast<Eigen::Index>(base_->size()));
  for (Eigen::Index j = 0; j < m; ++j)
    if (shares_[j] != 0.0) x.noalias() -= shares_[j] * *in_force_[static_cast<std::size_t>(j)];
}

}  // namespace signorini
