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

namespace signorini::statics {
namespace {

/// If a pivot ratio is below this value, null motions are searched for; the pivot of a null motion is only some eps.
constexpr double regular_share = 1e-9;
// If the part of a row that other rows do not span is smaller, relative to the row, it is a rounding error. Chosen value.
constexpr double spanned = 1e-9;

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

ConstraintRows::ConstraintRows(const SparseMatrix& k, std::vector<ConstraintRow> rows)
    : rows_(std::move(rows)),
      matrix_(assembly::with_springs(k, springs())),
      solver_(matrix_),
      regular_(solver_.ok() &&
               (solver_.smallest_pivot_ratio() > regular_share || null_motions(matrix_).cols() == 0)) {
  for (std::size_t j = 0; j < rows_.size(); ++j)
    if (rows_[j].rigid) rigid_.push_back(j);
  if (!regular()) return;
  const auto n = static_cast<Eigen::Index>(rigid_.size());
  schur_.resize(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    responses_.push_back(
        solver_.solve(assembly::dense_vector(rigid_row(i).form, static_cast<int>(k.rows()))));
    for (Eigen::Index j = 0; j < n; ++j) schur_(j, i) = rigid_row(j).form.dot(responses_.back());
  }
}

std::pair<Vector, Vector> ConstraintRows::solve(Vector load, const Vector& r) const {
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

std::vector<assembly::LineSpring> ConstraintRows::springs() const {
  std::vector<assembly::LineSpring> list;
  for (const ConstraintRow& row : rows_) list.push_back({row.form, row.stiffness});
  return list;
}

namespace {

constexpr double static_pivot_limit = 1e-3;  // smallest accepted pivot, relative to the row's largest entry
// A contact can fix a motion of size 1 only if the motion causes at least this slip at the contact.
constexpr double holds = 1e-6;
// Stiffness of a row / negative stiffness of K that the row must balance; sufficient even if the row balances two of them.
constexpr double firmly = 4.0;
constexpr double weak_share =
    1e-10;  // weak support, relative to the diagonal of K: keeps six digits in the sum
// A smaller work, relative to the largest load times the motion, does not drive a free motion.
constexpr double undriven = 1e-9;
// Degrees of freedom up to which a structure is solved as a whole; larger structures are solved part by part.
constexpr int together_up_to = 300;

/// Returns unit rows that complete `rows` (p x m, independent) to m independent rows. Each row takes the first column with a
/// sufficient pivot, so that a contact fixes the horizontal motion rather than a combination with a rotation.
Eigen::MatrixXd other_motions(Eigen::MatrixXd rows) {
  std::vector<bool> taken(static_cast<std::size_t>(rows.cols()), false);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    Eigen::Index pivot = 0;
    while (std::abs(rows(i, pivot)) < static_pivot_limit * rows.row(i).cwiseAbs().maxCoeff()) ++pivot;
    taken[static_cast<std::size_t>(pivot)] = true;
    for (Eigen::Index k = i + 1; k < rows.rows(); ++k) {
      rows.row(k) -= rows(k, pivot) / rows(i, pivot) * rows.row(i);
      rows(k, pivot) = 0.0;
    }
  }
  Eigen::MatrixXd others = Eigen::MatrixXd::Zero(rows.cols() - rows.rows(), rows.cols());
  Eigen::Index row = 0;
  for (Eigen::Index j = 0; j < rows.cols(); ++j)
    if (!taken[static_cast<std::size_t>(j)]) others(row++, j) = 1.0;
  return others;
}

/// Weak springs that keep a motion without load at zero. Both translations of a node have the same spring, the sum of
/// their stiffnesses, which does not depend on the axes: a motion orthogonal to a spring stays orthogonal.
SparseMatrix weak_support(const assembly::DofMap& map, const SparseMatrix& k) {
  const double largest = k.diagonal().cwiseAbs().maxCoeff();
  std::map<int, double> of_node;
  const auto node = [&](int i) { return map.locations[static_cast<std::size_t>(i)].first; };
  const auto translates = [&](int i) {
    return !map.is_matrix_scene() && !map.dofs[static_cast<std::size_t>(i)].rotation;
  };
  for (int i = 0; i < k.rows(); ++i)
    if (translates(i)) of_node[node(i)] += std::abs(k.coeff(i, i));
  SparseMatrix weak(k.rows(), k.cols());
  weak.setIdentity();
  for (int i = 0; i < k.rows(); ++i) {
    const double d = translates(i) ? of_node[node(i)] : std::abs(k.coeff(i, i));
    weak.coeffRef(i, i) = weak_share * (d > 0.0 ? d : largest > 0.0 ? largest : 1.0);
  }
  return weak;
}

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

namespace {

/// Motions that move no node (rotations of hinged ends) are separated from the other motions, since no contact acts on
/// them. In a combination with other motions, rounding would leave a translation that a contact would seem to fix.
struct Turning {
  Eigen::MatrixXd others;        ///< motions that move nodes
  std::vector<int> dofs;         ///< degrees of freedom that the rotations in `free` do not move
  std::vector<FreeMotion> free;  ///< motions that move no node, scaled to 1 at their largest entry

  Turning(const Eigen::MatrixXd& motions, const std::vector<int>& all, const assembly::DofMap& map) {
    std::vector<Eigen::Index> moving;
    std::vector<bool> turns(static_cast<std::size_t>(motions.rows()), false);
    for (Eigen::Index j = 0; j < motions.cols(); ++j) {
      if (assembly::max_translation(motions.col(j), map) > 0.0) {
        moving.push_back(j);
        continue;
      }
      for (const int i : all)
        if (motions(i, j) != 0.0) turns[static_cast<std::size_t>(i)] = true;
      free.push_back({motions.col(j) / motions.col(j).cwiseAbs().maxCoeff(), -1});
    }
    others = motions(Eigen::all, moving);
    std::copy_if(all.begin(), all.end(), std::back_inserter(dofs),
                 [&](int i) { return !turns[static_cast<std::size_t>(i)]; });
  }
};

/// Free motions of one part of the structure, each with the contact that fixes it.
std::vector<FreeMotion> fix_free_motions_of_part(const StaticProblem& problem, const Eigen::MatrixXd& motions,
                                                 const std::vector<int>& dofs,
                                                 const std::vector<std::size_t>& contacts,
                                                 const std::vector<bool>& closed, bool pressed_only) {
  Turning turning(motions, dofs, problem.map);
  Eigen::MatrixXd null = simple_motions(turning.others, problem.map, turning.dofs);
  for (Eigen::Index j = 0; j < null.cols(); ++j) {
    const double size = assembly::max_translation(null.col(j), problem.map);
    null.col(j) /= size > 0.0 ? size : null.col(j).cwiseAbs().maxCoeff();
  }
  const Eigen::Index m = null.cols();
  std::vector<int> holders;
  Eigen::MatrixXd rows(0, m);   // t_h . null
  Eigen::MatrixXd basis(m, 0);  // orthonormal basis of the rows so far
  auto consider = [&](std::size_t k) {
    if (static_cast<Eigen::Index>(holders.size()) == m) return;
    const Combination& tangent = problem.contacts[k].tangent;
    Eigen::VectorXd row(m);
    for (Eigen::Index j = 0; j < m; ++j) row[j] = tangent.dot(null.col(j));
    const Eigen::VectorXd rest = row - basis * (basis.transpose() * row);
    double form_size = 0.0;
    for (const auto& [i, a] : tangent.terms) form_size = std::max(form_size, std::abs(a));
    if (!(rest.norm() > holds * form_size)) return;
    basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
    basis.rightCols(1) = rest.normalized();
    rows.conservativeResize(rows.rows() + 1, Eigen::NoChange);
    rows.bottomRows(1) = row.transpose();
    holders.push_back(static_cast<int>(k));
  };
  for (bool pressed : {true, false})
    for (const std::size_t k : contacts)
      if ((!problem.is_support(k) || closed[k]) == pressed && (pressed || !pressed_only)) consider(k);
  if (m == 0) return std::move(turning.free);
  std::vector<FreeMotion> result;
  Eigen::MatrixXd complete(m, m);
  complete << rows, other_motions(rows);
  const Eigen::MatrixXd separate = null * base::solve_dense(complete, Eigen::MatrixXd::Identity(m, m));
  for (Eigen::Index j = 0; j < m; ++j)
    result.push_back({separate.col(j), j < rows.rows() ? holders[static_cast<std::size_t>(j)] : -1});
  std::move(turning.free.begin(), turning.free.end(), std::back_inserter(result));
  return result;
}

}  // namespace

std::vector<FreeMotion> constrain_free_motions(const StaticProblem& problem, const Eigen::MatrixXd& motions,
                                               const std::vector<bool>& closed, bool pressed_only) {
  std::vector<std::size_t> all(problem.contacts.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (problem.size() <= together_up_to) {
    std::vector<int> dofs(static_cast<std::size_t>(problem.size()));
    std::iota(dofs.begin(), dofs.end(), 0);
    return fix_free_motions_of_part(problem, motions, dofs, all, closed, pressed_only);
  }
  std::vector<Combination> tangents;
  for (const Contact& c : problem.contacts) tangents.push_back(c.tangent);
  const SparseMatrix k = problem.matrix(closed);
  const assembly::Parts parts({&k}, tangents);
  std::vector<std::vector<Eigen::Index>> own_motions(parts.count());
  std::vector<std::vector<std::size_t>> own_contacts(parts.count());
  for (Eigen::Index j = 0; j < motions.cols(); ++j) {
    Eigen::Index dof = 0;  // a motion without resistance lies in one part
    motions.col(j).cwiseAbs().maxCoeff(&dof);
    own_motions[parts.part_of(static_cast<int>(dof))].push_back(j);
  }
  for (const std::size_t c : all)
    if (!tangents[c].terms.empty()) own_contacts[parts.part_of(tangents[c].terms.front().first)].push_back(c);
  std::vector<FreeMotion> result;
  std::size_t number = 0;
  for (const assembly::Part& part : parts) {
    const Eigen::MatrixXd own = motions(Eigen::all, own_motions[number]);
    std::vector<FreeMotion> held =
        fix_free_motions_of_part(problem, own, part.dofs(), own_contacts[number++], closed, pressed_only);
    std::move(held.begin(), held.end(), std::back_inserter(result));
  }
  return result;
}

namespace {

/// Contact springs that are stiffer than K along their normals: in one matrix with them, K would keep too few digits,
/// and along inclined axes a soft motion would have a relative error of 1e-12. The forces kn (n . u + g0) n of these
/// springs are summed separately.
struct StiffContacts {
  const StaticProblem& problem;
  std::vector<bool> soft;  ///< closed contacts, without the stiff ones
  std::vector<std::size_t> list;

  StiffContacts(const StaticProblem& of, const std::vector<bool>& closed) : problem(of), soft(closed) {
    for (std::size_t c = 0; c < closed.size(); ++c) {
      const Contact& contact = of.contacts[c];
      if (!closed[c] || !contact.normal_spring()) continue;
      if (!(contact.normal_stiffness > structural_stiffness(of.stiffness, contact.normal))) continue;
      soft[c] = false;
      list.push_back(c);
    }
  }
  /// Residual: load - matrix u, minus the forces of the stiff contacts. with_gaps: these forces include g0.
  [[nodiscard]] Vector rest(const SparseMatrix& matrix, const Vector& load, const Vector& u,
                            bool with_gaps) const {
    Vector rest = load - matrix * u;
    for (const std::size_t c : list) {
      const Contact& contact = problem.contacts[c];
      const double g = with_gaps ? contact.gap_at(u) : contact.normal.dot(u);
      contact.normal.add_to(rest, -contact.normal_stiffness * g);
    }
    return rest;
  }
};

}  // namespace

ConstrainedState solve_constrained(const StaticProblem& problem, const std::vector<bool>& closed,
                                   const std::vector<FreeMotion>& held) {
  const SparseMatrix whole = problem.matrix(closed);
  std::vector<assembly::LineSpring> springs;
  bool loose = false;
  for (const FreeMotion& f : held) {
    if (f.contact_index < 0) {
      loose = true;
      continue;
    }
    const Combination& t = problem.contacts[static_cast<std::size_t>(f.contact_index)].tangent;
    springs.push_back({t, structural_stiffness(whole, t)});
  }
  const StiffContacts stiff(problem, closed);
  SparseMatrix k = assembly::with_springs(problem.matrix(stiff.soft), springs);
  const SparseMatrix unsupported = k;
  if (loose) k += weak_support(problem.map, assembly::with_springs(whole, springs));
  std::vector<assembly::LineSpring> apart;
  for (const std::size_t c : stiff.list)
    apart.push_back({problem.contacts[c].normal, problem.contacts[c].normal_stiffness});
  const linear::SymmetricSolver solver(apart.empty() ? k : assembly::with_springs(k, apart));
  // load: includes the gap terms of soft contacts. of_scene: true for the load of the scene; gap terms of stiff contacts are
  // then added.
  const auto refined = [&](const Vector& load, bool of_scene) {
    const Vector first = of_scene ? problem.right_side(closed) : load;
    const Vector u = solver.solve(first);
    const Vector better = u + solver.solve(stiff.rest(k, load, u, of_scene));
    return loose && problem.forces
               ? Vector(better + solver.solve(stiff.rest(unsupported, load, better, of_scene)))
               : better;
  };
  ConstrainedState state{refined(problem.right_side(stiff.soft), true),
                         std::vector<double>(problem.contacts.size(), 0.0)};
  std::vector<std::size_t> rigid;
  for (std::size_t c = 0; c < problem.contacts.size(); ++c)
    if (closed[c] && problem.contacts[c].takes_impulses()) rigid.push_back(c);
  if (!rigid.empty()) {  // n . (u + K^-1 n r) = -g0 at all rigid contacts, r = -N
    const auto m = static_cast<Eigen::Index>(rigid.size());
    Eigen::MatrixXd answer(problem.size(), m), give(m, m);
    Eigen::VectorXd miss(m);
    for (Eigen::Index j = 0; j < m; ++j)
      answer.col(j) = refined(
          assembly::dense_vector(problem.contacts[rigid[static_cast<std::size_t>(j)]].normal, problem.size()),
          false);
    for (Eigen::Index i = 0; i < m; ++i) {
      const std::size_t c = rigid[static_cast<std::size_t>(i)];
      miss[i] = -problem.gap(c, state.u);
      for (Eigen::Index j = 0; j < m; ++j) give(i, j) = problem.contacts[c].normal.dot(answer.col(j));
    }
    const Eigen::VectorXd r = base::least_squares(give, miss);
    state.u += answer * r;
    for (Eigen::Index i = 0; i < m; ++i) state.reactions[rigid[static_cast<std::size_t>(i)]] = r[i];
  }
  for (std::size_t c = 0; c < problem.contacts.size(); ++c)
    if (closed[c] && problem.contacts[c].normal_spring())
      state.reactions[c] = std::max(0.0, -problem.normal_stiffness(c) * problem.gap(c, state.u));
  return state;
}

double driving_work(const StaticProblem& problem, const SparseMatrix& k, const Vector& p,
                    const Vector& motion, const Vector& u) {
  const double work = motion.dot(p - k * u);
  const double roundoff =
      rounding::many_operations * motion.cwiseAbs().dot(k.cwiseAbs() * u.cwiseAbs() + p.cwiseAbs());
  double motion_size[2]{0.0, 0.0}, load_size[2]{0.0, 0.0};  // translations, rotations
  for (int i = 0; i < problem.size(); ++i) {
    const std::size_t kind = problem.map.dofs[static_cast<std::size_t>(i)].rotation ? 1 : 0;
    motion_size[kind] = std::max(motion_size[kind], std::abs(motion[i]));
    load_size[kind] = std::max(load_size[kind], std::abs(p[i]));
  }
  const double all = undriven * (motion_size[0] * load_size[0] + motion_size[1] * load_size[1]);
  return std::abs(work) > roundoff + all ? work : 0.0;
}

}  // namespace signorini::statics
