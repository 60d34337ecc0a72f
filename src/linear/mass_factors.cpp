#include "linear/mass_factors.hpp"

#include <algorithm>
#include <cstdint>

#include "base/eigen_dense.hpp"
#include "linear/klu.hpp"

namespace signorini::linear {

std::shared_ptr<const TriangularFactors> mass_factors(const SystemMatrices& structure) {
  std::vector<std::int64_t> start(1, 0), row;
  std::vector<double> value;
  for (std::size_t j = 0; j < static_cast<std::size_t>(structure.size); ++j) {
    for (auto p = static_cast<std::size_t>(structure.column_start[j]);
         p < static_cast<std::size_t>(structure.column_start[j + 1]); ++p) {
      if (structure.m[p] == 0.0) continue;
      row.push_back(structure.row[p]);
      value.push_back(structure.m[p]);
    }
    start.push_back(static_cast<std::int64_t>(row.size()));
  }
  Klu klu(start, row);
  if (!klu.factor(value)) return nullptr;
  return std::make_shared<const TriangularFactors>(klu.factors());
}

std::vector<ContactForceBlock> contact_force_blocks(const std::vector<Rows>& rows) {
  std::vector<ContactForceBlock> result;
  result.reserve(rows.size());
  for (const Rows& r : rows) {
    const ContactForceBlock b{r.normal.N, r.normal.T, r.tangent.N, r.tangent.T};
    const bool accelerates =
        r.normal.an != 0.0 || r.normal.at != 0.0 || r.tangent.an != 0.0 || r.tangent.at != 0.0;
    // N follows from the normal row alone, then T from the tangent row, so no elimination can lose digits.
    if (accelerates || b.normal_T != 0.0 || b.normal_N == 0.0 || b.tangent_T == 0.0) return {};
    result.push_back(b);
  }
  return result;
}

void MassSolver::solve(double* x, double* work) const {
  double* const forces = x + mass_->size();
  const ForceLayout& layout = model_->layout;
  for (std::size_t c = 0; c < forces_.size(); ++c) {
    const ContactForceBlock& b = forces_[c];
    double &in_N = forces[layout.normal(c)], &in_T = forces[layout.tangent(c)];
    const double N = in_N / b.normal_N, T = (in_T - b.tangent_N * N) / b.tangent_T;
    in_N = N;
    in_T = T;
    const Contact& contact = model_->contacts[c];
    if (N != 0.0)
      for (const auto& [dof, factor] : contact.normal.terms) x[dof] -= factor * N;
    if (T != 0.0)
      for (const auto& [dof, factor] : contact.tangent.terms) x[dof] -= factor * T;
  }
  mass_->solve(x, work);
}

namespace {

// Smallest accepted reciprocal condition of 1 + D Y: a loss of three digits, as for pivots kept from another step size
// (linear/klu.cpp). The limit also bounds D Y, because for large D Y the solution is a small difference of x and a multiple
// of Y, which loses digits, too.
constexpr double min_reciprocal_condition = 1e-3;
// Largest number of columns of Y that are stored; stored columns are used again if the same rows change again.
constexpr std::size_t most_columns = 4 * WoodburyFactors::max_rows;

double dot(const ChangedRow& row, const double* x) {
  double sum = 0.0;
  for (const auto& [column, value] : row.entries) sum += value * x[column];
  return sum;
}

double norm(const Eigen::MatrixXd& a) { return a.cwiseAbs().rowwise().sum().maxCoeff(); }

}  // namespace

void WoodburyFactors::set_base(std::shared_ptr<const TriangularFactors> base) {
  base_ = std::move(base);
  columns_.clear();
  rows_.clear();
}

const Eigen::VectorXd& WoodburyFactors::column(std::size_t row) {
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

bool WoodburyFactors::set(std::vector<ChangedRow> rows) {
  if (!base_ || rows.size() > max_rows) return false;
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
  inverse_ = base::solve_dense(one + added, one);
  const double size = 1.0 + norm(added);
  return min_reciprocal_condition * size * std::max(1.0, norm(inverse_)) <= 1.0;  // false for NaN
}

void WoodburyFactors::solve(double* b, double* work) {
  base_->solve(b, work);
  if (rows_.empty()) return;
  const auto m = static_cast<Eigen::Index>(rows_.size());
  for (Eigen::Index i = 0; i < m; ++i) parts_[i] = dot(rows_[static_cast<std::size_t>(i)], b);
  shares_.noalias() = inverse_ * parts_;
  Eigen::Map<Eigen::VectorXd> x(b, static_cast<Eigen::Index>(base_->size()));
  for (Eigen::Index j = 0; j < m; ++j)
    if (shares_[j] != 0.0) x.noalias() -= shares_[j] * *in_force_[static_cast<std::size_t>(j)];
}

}  // namespace signorini::linear
