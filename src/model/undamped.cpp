#include "model/undamped.hpp"

#include <cmath>

#include "base/rounding.hpp"
#include "model/statics/null_motions.hpp"

namespace signorini {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Massless degrees of freedom with a damper.
std::vector<int> damped_without_mass(const Model& model) {
  std::vector<int> list;
  for (int i = 0; i < model.size(); ++i)
    if (model.dofs[static_cast<std::size_t>(i)].massless && model.damping.coeff(i, i) > 0.0)
      list.push_back(i);
  return list;
}

/// C restricted to these degrees of freedom.
SparseMatrix part_of(const SparseMatrix& c, const std::vector<int>& list) {
  std::vector<int> position(static_cast<std::size_t>(c.rows()), -1);
  for (std::size_t j = 0; j < list.size(); ++j)
    position[static_cast<std::size_t>(list[j])] = static_cast<int>(j);
  Triplets entries;
  for (int column = 0; column < c.outerSize(); ++column)
    for (SparseMatrix::InnerIterator it(c, column); it; ++it) {
      const int row = position[static_cast<std::size_t>(it.row())],
                at = position[static_cast<std::size_t>(column)];
      if (row >= 0 && at >= 0) entries.emplace_back(row, at, it.value());
    }
  const auto size = static_cast<Eigen::Index>(list.size());
  SparseMatrix part(size, size);
  part.setFromTriplets(entries.begin(), entries.end());
  return part;
}

/// A basis of the same span; each column has a row in which it is 1 and all others are 0.
std::vector<Eigen::Index> give_rows(Eigen::MatrixXd& z) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index j = 0; j < z.cols(); ++j) {
    Eigen::Index row = 0;
    z.col(j).cwiseAbs().maxCoeff(&row);
    z.col(j) /= z(row, j);
    for (Eigen::Index other = 0; other < z.cols(); ++other)
      if (other != j) z.col(other) -= z(row, other) * z.col(j);
    rows.push_back(row);
  }
  for (Eigen::Index j = 0; j < z.cols(); ++j) {
    const double rounding = rounding::of_many * z.col(j).cwiseAbs().maxCoeff();
    for (double& x : z.col(j)) x = std::abs(x) <= rounding ? 0.0 : x;
  }
  return rows;
}

/// B^T n; terms that cancel become zero.
Combination in_basis(const Combination& form, const SparseMatrix& basis) {
  Vector sum = Vector::Zero(basis.cols()), size = sum;
  for (const auto& [i, factor] : form.terms)
    for (int j = 0; j < basis.outerSize(); ++j)
      if (const double b = basis.coeff(i, j); b != 0.0) {
        sum[j] += factor * b;
        size[j] += std::abs(factor * b);
      }
  Combination result;
  for (int j = 0; j < sum.size(); ++j)
    if (std::abs(sum[j]) > rounding::of_few * size[j]) result.terms.emplace_back(j, sum[j]);
  return result;
}

void change_basis(Model& model, const SparseMatrix& basis, const std::vector<bool>& undamped) {
  model.stiffness = SparseMatrix(basis.transpose() * SparseMatrix(model.stiffness * basis));
  model.damping = SparseMatrix(basis.transpose() * SparseMatrix(model.damping * basis));
  model.damping.prune([&](Eigen::Index row, Eigen::Index column, double) {
    return !undamped[static_cast<std::size_t>(row)] && !undamped[static_cast<std::size_t>(column)];
  });
  for (Load& load : model.loads) load.direction = in_basis(load.direction, basis);
  for (Contact& contact : model.contacts) {
    contact.normal = in_basis(contact.normal, basis);
    contact.tangent = in_basis(contact.tangent, basis);
  }
  // B^-1 = 2 - B: B adds to some degrees of freedom only multiples of those that it leaves unchanged.
  for (Vector* x : {&model.u0, &model.v0}) *x = 2.0 * *x - basis * *x;
  model.basis = basis;
}

}  // namespace

void separate_undamped(Model& model) {
  const std::vector<int> damped = damped_without_mass(model);
  if (damped.empty()) return;
  Eigen::MatrixXd z = null_motions(part_of(model.damping, damped));
  if (z.cols() == 0) return;
  const std::vector<Eigen::Index> rows = give_rows(z);
  const int n = model.size();
  SparseMatrix basis(n, n);
  Triplets entries;
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, 1.0);
  std::vector<bool> undamped(static_cast<std::size_t>(n), false);
  for (Eigen::Index j = 0; j < z.cols(); ++j) {
    const int p = damped[static_cast<std::size_t>(rows[static_cast<std::size_t>(j)])];
    undamped[static_cast<std::size_t>(p)] = true;
    for (Eigen::Index i = 0; i < z.rows(); ++i)
      if (const int row = damped[static_cast<std::size_t>(i)]; row != p && z(i, j) != 0.0)
        entries.emplace_back(row, p, z(i, j));
  }
  basis.setFromTriplets(entries.begin(), entries.end());
  change_basis(model, basis, undamped);
}

}  // namespace signorini
