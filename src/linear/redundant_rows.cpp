#include "linear/redundant_rows.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/containers.hpp"
#include "base/eigen_dense.hpp"
#include "contact/motion.hpp"

namespace signorini::linear {
namespace {

// A column is linearly dependent if its part orthogonal to earlier columns is below this fraction of its norm. Rounding errors
// are smaller than this fraction.
constexpr double dependent = 1e-12;

}  // namespace

// Factors h = Q R on the columns that are independent of earlier ones, by Gram-Schmidt orthogonalisation, applied twice.
Eigen::MatrixXd null_of_columns(const Eigen::MatrixXd& h) {
  const Eigen::Index most = std::min(h.rows(), h.cols());
  Eigen::MatrixXd q(h.rows(), most), r = Eigen::MatrixXd::Zero(most, most), null(h.cols(), 0);
  std::vector<Eigen::Index> own;
  for (Eigen::Index j = 0; j < h.cols(); ++j) {
    const auto k = static_cast<Eigen::Index>(own.size());
    Eigen::VectorXd rest = h.col(j), part = Eigen::VectorXd::Zero(k);
    for (int round = 0; round < 2 && k > 0; ++round) {
      const Eigen::VectorXd more = q.leftCols(k).transpose() * rest;
      rest -= q.leftCols(k) * more;
      part += more;
    }
    const double length = rest.norm();
    if (k < most && length > dependent * h.col(j).norm()) {
      q.col(k) = rest / length;
      r.col(k).head(k) = part;
      r(k, k) = length;
      own.push_back(j);
      continue;
    }
    null.conservativeResize(Eigen::NoChange, null.cols() + 1);
    null.rightCols(1).setZero();
    for (Eigen::Index i = k - 1; i >= 0; --i) {
      double x = part[i];
      for (Eigen::Index l = i + 1; l < k; ++l)
        x -= r(i, l) * null(own[static_cast<std::size_t>(l)], null.cols() - 1);
      null(own[static_cast<std::size_t>(i)], null.cols() - 1) = x / r(i, i);
    }
    null(j, null.cols() - 1) = -1.0;
  }
  return null.cols() == 0 ? null : base::orthonormal(null);
}

bool participates_in(const Eigen::MatrixXd& null, Eigen::Index i) { return null.row(i).norm() > dependent; }

namespace {

/// dT/dN of a contact at its friction limit; 0 if T is independent of N.
double friction_of_compression(const Rows& rows) {
  return rows.tangent.T != 0.0 ? -rows.tangent.N / rows.tangent.T : 0.0;
}

const Combination& form_of(const Model& model, std::size_t row) {
  const Contact& contact = model.contacts[model.layout.contact_of(row)];
  return model.layout.is_normal(row) ? contact.normal : contact.tangent;
}

}  // namespace

bool RedundantRows::has_mass(const Combination& form) const {
  return !form.terms.empty() && std::all_of(form.terms.begin(), form.terms.end(), [&](const auto& term) {
    return inverse_mass_[static_cast<std::size_t>(term.first)] > 0.0;
  });
}

/// Groups of rigid contacts, and of sliders on ground at rest, that act on common degrees of freedom. On moving ground, sliders
/// whose surfaces have different motions do not constrain a common motion.
std::vector<std::vector<std::size_t>> RedundantRows::coupled_groups() const {
  base::DisjointSets sets(model_.contacts.size());
  std::unordered_map<int, std::size_t> first;  // first contact on each degree of freedom
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const Contact& contact = model_.contacts[k];
    const bool slides = contact.sticks_rigidly() && contact.surface_motion.is_constant();
    if (!contact.takes_impulses() && !(slides && has_mass(contact.tangent))) continue;
    if (contact.takes_impulses())
      for (const auto& term : contact.normal.terms) sets.join(k, first.emplace(term.first, k).first->second);
    for (const auto& term : contact.tangent.terms) sets.join(k, first.emplace(term.first, k).first->second);
  }
  std::vector<std::vector<std::size_t>> groups = sets.sets();
  std::erase_if(groups, [](const std::vector<std::size_t>& group) { return group.size() < 2; });
  return groups;
}

RedundantRows::RedundantRows(const Model& model, const SystemMatrices& structure)
    : model_(model),
      inverse_mass_(static_cast<std::size_t>(structure.size), 0.0),
      grouped_(model.contacts.size(), false) {
  for (int j = 0; j < structure.size; ++j)
    for (auto p = static_cast<std::size_t>(structure.column_start[static_cast<std::size_t>(j)]);
         p < static_cast<std::size_t>(structure.column_start[static_cast<std::size_t>(j) + 1]); ++p)
      if (structure.row[p] == j && structure.m[p] > 0.0)
        inverse_mass_[static_cast<std::size_t>(j)] = 1.0 / structure.m[p];
  for (std::vector<std::size_t>& group : coupled_groups()) {
    std::vector<std::size_t> rows;
    for (const std::size_t k : group) {
      if (model.contacts[k].takes_impulses()) rows.push_back(model.layout.normal(k));
      if (model.contacts[k].sticks_rigidly()) rows.push_back(model.layout.tangent(k));
    }
    // Groups in which only normals are redundant are omitted: two walls on opposite sides of a mass never close at once.
    const Eigen::MatrixXd null = null_of_columns(columns(rows));
    bool friction = false;
    for (std::size_t i = 0; i < rows.size() && null.cols() > 0; ++i)
      friction = friction ||
                 (!model.layout.is_normal(rows[i]) && participates_in(null, static_cast<Eigen::Index>(i)));
    if (!friction) continue;
    for (const std::size_t k : group) grouped_[k] = true;
    groups_.push_back(std::move(group));
  }
}

Eigen::MatrixXd RedundantRows::columns(const std::vector<std::size_t>& rows) const {
  std::vector<const Combination*> forms;
  for (const std::size_t row : rows) forms.push_back(&form_of(model_, row));
  return contact::form_columns(
      forms, [&](int dof) { return std::sqrt(inverse_mass_[static_cast<std::size_t>(dof)]); });
}

std::vector<SharedForces> RedundantRows::in_force(const std::vector<Rows>& rows) const {
  std::vector<SharedForces> result;
  for (const std::vector<std::size_t>& group : groups_) {
    SharedForces shared;
    for (const std::size_t k : group) {
      if (rows[k].normal.an != 0.0 && rows[k].normal.N == 0.0) shared.rows.push_back(model_.layout.normal(k));
      if (rows[k].tangent.at != 0.0 && rows[k].tangent.T == 0.0)
        shared.rows.push_back(model_.layout.tangent(k));
    }
    if (shared.rows.size() < 2) continue;
    const auto count = static_cast<Eigen::Index>(shared.rows.size());
    std::vector<std::size_t> forms = shared.rows;
    const ForceLayout& layout = model_.layout;
    for (const std::size_t row : shared.rows) forms.push_back(layout.tangent(layout.contact_of(row)));
    const Eigen::MatrixXd all = columns(forms);
    const Eigen::MatrixXd h = all.leftCols(count);
    shared.null = null_of_columns(h);
    if (shared.null.cols() == 0) continue;
    Eigen::MatrixXd h_f = h;
    // Diagonal of D: sum of the squares of N and T that a unit of the force produces.
    Eigen::VectorXd squares = Eigen::VectorXd::Ones(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const std::size_t row = shared.rows[static_cast<std::size_t>(i)];
      if (!layout.is_normal(row)) continue;
      const double ratio = friction_of_compression(rows[layout.contact_of(row)]);
      h_f.col(i) += ratio * all.col(count + i);
      squares[i] += ratio * ratio;
    }
    Eigen::MatrixXd open = null_of_columns(h_f);
    if (open.cols() != shared.null.cols()) open = shared.null;
    const double size = h.colwise().squaredNorm().maxCoeff();
    shared.entries = size * shared.null * (squares.asDiagonal() * open).transpose();
    result.push_back(std::move(shared));
  }
  return result;
}

}  // namespace signorini::linear
