#include "model/statics/static_system.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "contact/motion.hpp"
#include "linear/sparse_cholesky.hpp"
#include "model/assembly/dofs.hpp"
#include "model/assembly/motion_names.hpp"
#include "model/assembly/parts.hpp"
#include "model/assembly/springs.hpp"
#include "model/statics/mechanisms.hpp"
#include "model/statics/residual.hpp"

namespace signorini::statics {
namespace {

/// If a pivot ratio is below this value, null motions are searched for; the pivot of a null motion is only some eps.
constexpr double regular_share = 1e-9;
// If the part of a row that other rows do not span is smaller, relative to the row, it is a rounding error. Chosen value.
constexpr double spanned = 1e-9;
// Limit of the number of corrections. Each is smaller than the one before by cond(K) eps, and at least by half.
constexpr int most_refinements = 10;

}  // namespace

bool is_also_constrained(const std::vector<ConstraintRow>& rows, const std::vector<bool>& loose,
                         std::size_t row) {
  std::vector<const Combination*> forms{&rows[row].form};
  for (std::size_t j = 0; j < rows.size(); ++j)
    if (j != row && rows[j].rigid && !loose[j]) forms.push_back(&rows[j].form);
  if (!rows[row].rigid || forms.size() < 2) return false;
  const Eigen::MatrixXd columns = contact::form_columns(forms);
  const Eigen::MatrixXd others = columns.rightCols(columns.cols() - 1);
  const Eigen::VectorXd own = columns.col(0);
  return (own - others * base::least_squares(others, own)).norm() <= spanned * own.norm();
}

ConstraintRows::ConstraintRows(const SparseMatrix& k, std::vector<ConstraintRow> rows,
                               const std::vector<Combination>& pins)
    : k_(&k),
      rows_(std::move(rows)),
      springs_(springs(pins)),
      matrix_(assembly::with_springs(k, springs_)),
      solver_(matrix_),
      regular_(solver_.ok() &&
               (solver_.smallest_pivot_ratio() > regular_share || null_motions(matrix_).cols() == 0)) {
  for (std::size_t j = 0; j < rows_.size(); ++j)
    if (rows_[j].rigid) rigid_.push_back(j);
  if (!solver_.ok()) return;
  const auto n = static_cast<Eigen::Index>(rigid_.size());
  schur_.resize(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    responses_.push_back(response(rigid_row(i).form));
    for (Eigen::Index j = 0; j < n; ++j) schur_(j, i) = rigid_row(j).form.dot(responses_.back());
  }
}

/// u of the matrix for a unit load along the form.
Vector ConstraintRows::response(const Combination& form) const {
  const Vector load = assembly::dense_vector(form, static_cast<int>(k_->rows()));
  Vector u = solver_.solve(load);
  Residual rest(load);
  rest.subtract(*k_, u);
  for (const assembly::LineSpring& spring : springs_)
    rest.subtract(spring.form, spring.stiffness * exact_dot(spring.form, u));
  u += solver_.solve(rest.rounded());
  return u;
}

std::pair<Vector, Vector> ConstraintRows::solve_once(Vector load, const Vector& r) const {
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
    const Eigen::VectorXd multipliers = base::least_squares(schur_, miss);
    for (Eigen::Index i = 0; i < n; ++i) {
      u -= multipliers[i] * responses_[static_cast<std::size_t>(i)];
      forces[static_cast<Eigen::Index>(rigid_[static_cast<std::size_t>(i)])] = multipliers[i];
    }
  }
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    forces[i] += rows_[j].rigid ? 0.0 : rows_[j].stiffness * (rows_[j].form.dot(u) - r[i]);
  }
  return {std::move(u), std::move(forces)};
}

std::pair<Vector, Vector> ConstraintRows::solve(const Vector& load, const Vector& r) const {
  auto result = solve_once(load, r);
  refine(load, r, result.first, result.second);
  return result;
}

void ConstraintRows::refine(const Vector& load, const Vector& r, Vector& u, Vector& forces) const {
  const auto stretch = [&](std::size_t j) {
    return exact_dot(rows_[j].form, u) - static_cast<long double>(r[static_cast<Eigen::Index>(j)]);
  };
  // The work of the unbalanced forces on the correction: one number in one unit, quadratic in the error.
  double last = load.cwiseAbs().dot(u.cwiseAbs()) + r.cwiseAbs().dot(forces.cwiseAbs());
  for (int round = 0; round < most_refinements; ++round) {
    Residual rest(load);
    rest.subtract(*k_, u);
    Vector miss = Vector::Zero(r.size());
    for (std::size_t j = 0; j < rows_.size(); ++j) {
      const auto i = static_cast<Eigen::Index>(j);
      if (rows_[j].rigid) miss[i] = static_cast<double>(-stretch(j));
      rest.subtract(rows_[j].form, rows_[j].rigid ? forces[i] : rows_[j].stiffness * stretch(j));
    }
    const Vector unbalanced = rest.rounded();
    const auto [du, df] = solve_once(unbalanced, miss);
    const double work = unbalanced.cwiseAbs().dot(du.cwiseAbs()) + miss.cwiseAbs().dot(df.cwiseAbs());
    if (!(work < 0.25 * last)) break;
    last = work;
    u += du;
    for (const std::size_t j : rigid_)
      forces[static_cast<Eigen::Index>(j)] += df[static_cast<Eigen::Index>(j)];
  }
  for (std::size_t j = 0; j < rows_.size(); ++j)
    if (!rows_[j].rigid)
      forces[static_cast<Eigen::Index>(j)] = static_cast<double>(rows_[j].stiffness * stretch(j));
}

std::vector<assembly::LineSpring> ConstraintRows::springs(const std::vector<Combination>& pins) const {
  std::vector<assembly::LineSpring> list;
  for (const ConstraintRow& row : rows_) list.push_back({row.form, row.stiffness});
  if (pins.empty()) return list;
  const SparseMatrix whole = assembly::with_springs(*k_, list);
  for (const Combination& pin : pins) list.push_back({pin, structural_stiffness(whole, pin)});
  return list;
}

namespace {

// Stiffness of a row / negative stiffness of K that the row must balance; sufficient even if the row balances two of them.
constexpr double firmly = 4.0;

}  // namespace

double structural_stiffness(const SparseMatrix& k, const Combination& form) {
  double sum = 0.0;
  for (const auto& [i, a] : form.terms) sum += a * a * std::abs(k.coeff(i, i));
  double length = 0.0;
  for (const auto& [i, a] : form.terms) length += a * a;
  // The row alone must balance a negative stiffness of K, for example that of a block whose weight would topple it.
  double against = 0.0;
  for (const auto& [i, a] : form.terms)
    if (a != 0.0) against = std::max(against, -firmly * k.coeff(i, i) / (a * a));
  if (sum > 0.0) return std::max(sum / (length * length), against);
  // If there is no stiffness along the form, the largest stiffness of the structure is used.
  const double largest = k.diagonal().cwiseAbs().maxCoeff();
  return largest > 0.0 ? largest / length : 1.0 / length;
}

SparseMatrix StaticProblem::matrix(const std::vector<bool>& closed) const {
  std::vector<assembly::LineSpring> springs;
  for (std::size_t k = 0; k < contacts.size(); ++k)
    if (is_support(k) && closed[k]) springs.push_back({contacts[k].normal, normal_stiffness(k)});
  return assembly::with_springs(stiffness, springs);
}

Vector StaticProblem::right_side(const std::vector<bool>& closed) const {
  Vector p = load;
  for (std::size_t k = 0; k < contacts.size(); ++k)
    if (is_support(k) && closed[k]) contacts[k].normal.add_to(p, -normal_stiffness(k) * contacts[k].gap);
  return p;
}

}  // namespace signorini::statics
