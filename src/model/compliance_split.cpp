#include "model/compliance_split.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "linear/sparse_cholesky.hpp"
#include "model/assembly/parts.hpp"
#include "model/assembly/springs.hpp"

namespace signorini::model {
namespace {

// The columns of B, scaled to length 1, are linearly independent if the smallest eigenvalue of B^T B is above this value.
constexpr double independent = 1e-9;

[[noreturn]] void refuse_compliance_split(const Scene& scene, std::size_t k, const char* key,
                                          const std::string& why) {
  throw SceneError(scene.contacts[k].place, scene.contacts[k].key(key), why);
}

const Dof* first_massless(const Model& model, const Combination& form) {
  for (const auto& [dof, factor] : form.terms)
    if (const Dof& d = model.dofs[static_cast<std::size_t>(dof)]; d.massless && factor != 0.0) return &d;
  return nullptr;
}

/// One column of B: the direction n or t of a contact on parts without mass.
struct Row {
  std::size_t contact;
  bool normal;
  const Dof* dof;  ///< one of the massless degrees of freedom in this direction, for messages
};

/// One row for each direction of a rigid contact on parts without mass. Errors: SceneError if a contact moves parts
/// without mass along only one of n and t, or has a restitution.
std::vector<Row> rows_of(const Scene& scene, const Model& model) {
  std::vector<Row> rows;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    if (!c.takes_impulses()) continue;
    const Dof* along_n = first_massless(model, c.normal);
    const Dof* along_t = c.has_friction() ? first_massless(model, c.tangent) : nullptr;
    if (!along_n && !along_t) continue;
    if (!along_n || (c.has_friction() && !along_t))
      refuse_compliance_split(
          scene, k, "law",
          fmt::format("{} has no mass, but the contact's {} moves only parts with mass: expected mass along "
                      "both directions, along neither, or law = \"compliant\"",
                      (along_n ? along_n : along_t)->displacement, along_n ? "tangent" : "normal"));
    if (scene.contacts[k].restitution != 0.0 || scene.contacts[k].capture_velocity)
      refuse_compliance_split(
          scene, k, scene.contacts[k].restitution != 0.0 ? "restitution" : "capture_velocity",
          fmt::format("{} has no mass, so nothing rebounds there: remove this key", along_n->displacement));
    rows.push_back({k, true, along_n});
    if (along_t) rows.push_back({k, false, along_t});
  }
  return rows;
}

const Combination& form_of_row(const Model& model, const Row& row) {
  const Contact& c = model.contacts[row.contact];
  return row.normal ? c.normal : c.tangent;
}

/// S = B (B^T B)^-1, size n x rows. Errors: SceneError if the columns of B are linearly dependent.
SparseMatrix shifts(const Scene& scene, const Model& model, const std::vector<Row>& rows) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < rows.size(); ++j)
    for (const auto& [dof, factor] : form_of_row(model, rows[j]).terms)
      if (model.dofs[static_cast<std::size_t>(dof)].massless && factor != 0.0)
        entries.emplace_back(dof, static_cast<int>(j), factor);
  const auto m = static_cast<Eigen::Index>(rows.size());
  SparseMatrix b(model.size(), m);
  b.setFromTriplets(entries.begin(), entries.end());
  Eigen::MatrixXd square = Eigen::MatrixXd(SparseMatrix(b.transpose() * b));
  const Eigen::VectorXd size = square.diagonal().cwiseSqrt();
  for (Eigen::Index j = 0; j < m; ++j) square.col(j).array() /= size.array() * size[j];
  const base::EigenPairs pairs = base::symmetric_eigen(square);
  if (!(pairs.values[0] > independent)) {
    Eigen::Index most = 0;
    pairs.vectors.col(0).cwiseAbs().maxCoeff(&most);
    const Row& row = rows[static_cast<std::size_t>(most)];
    refuse_compliance_split(
        scene, row.contact, "law",
        fmt::format("{} has no mass, and several rigid contacts act on it, so the force of each of them is "
                    "undetermined; remove all but one, or give them law = \"compliant\"",
                    row.dof->displacement));
  }
  square = size.asDiagonal() * square * size.asDiagonal();
  const Eigen::MatrixXd inverse = base::solve_dense(square, Eigen::MatrixXd::Identity(m, m));
  SparseMatrix s = b * SparseMatrix(inverse.sparseView(1.0, rounding::eps * inverse.cwiseAbs().maxCoeff()));
  return s;
}

/// Errors: SceneError if beta K or a damper acts on motions along the columns of S.
void check_undamped(const Scene& scene, const SparseMatrix& dampers, const std::vector<Row>& rows,
                    const SparseMatrix& s) {
  const bool beta = scene.damping.beta > 0.0;
  const SparseMatrix damped = dampers * s;
  const auto refuse_damping = [&](Eigen::Index j, const char* what) {
    const Row& row = rows[static_cast<std::size_t>(j)];
    refuse_compliance_split(
        scene, row.contact, "law",
        fmt::format("{} has no mass, but {}, and a rigid contact without mass cannot have damping: remove "
                    "the damping, or give the contact law = \"compliant\"",
                    row.dof->displacement, what));
  };
  for (Eigen::Index j = 0; j < s.cols(); ++j) {
    if (beta) refuse_damping(j, "damping.beta damps its motion");
    if (damped.col(j).norm() > 0.0) refuse_damping(j, "a damper acts there");
  }
}

/// Replaces the loads f by f' = f + K S X S^T f, and sets Model::load_corrections, which convert displacements u' and energies
/// to those of u.
void shift_loads(const SparseMatrix& s, const SparseMatrix& ks, const Eigen::MatrixXd& x, Model& model) {
  std::vector<Vector> pushes;
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    Combination& direction = model.loads[i].direction;
    const Vector f = assembly::dense_vector(direction, model.size());
    Vector along = s.transpose() * f;
    const Vector terms = s.cwiseAbs().transpose() * f.cwiseAbs();
    for (Eigen::Index j = 0; j < along.size(); ++j)
      if (std::abs(along[j]) <= rounding::many_operations * terms[j]) along[j] = 0.0;
    if (along.isZero(0.0)) continue;
    const Vector shifted = x * along;
    const Vector moved = s * shifted, added = ks * shifted;
    model.load_corrections.push_back({i, -moved, {}});
    const Vector all = f + added;
    direction.terms.clear();
    for (Eigen::Index k = 0; k < all.size(); ++k)
      if (all[k] != 0.0) direction.terms.emplace_back(static_cast<int>(k), all[k]);
    pushes.push_back(std::move(along));
  }
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    model.load_corrections[i].energies.resize(static_cast<Eigen::Index>(pushes.size()));
    for (std::size_t j = 0; j < pushes.size(); ++j)
      model.load_corrections[i].energies[static_cast<Eigen::Index>(j)] = pushes[i].dot(x * pushes[j]);
  }
}

/// Returns K + A X A^T, for a sparse A of size n x m and a dense X of size m x m.
SparseMatrix with_block(const SparseMatrix& k, const SparseMatrix& a, const Eigen::MatrixXd& x) {
  std::vector<int> touched;
  Vector any = Vector::Zero(a.rows());
  for (int j = 0; j < a.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(a, j); it; ++it) any[it.row()] = 1.0;
  for (int i = 0; i < any.size(); ++i)
    if (any[i] != 0.0) touched.push_back(i);
  const SparseMatrix pick = assembly::selection(touched, static_cast<int>(a.rows()));
  const Eigen::MatrixXd part(SparseMatrix(pick.transpose() * a));
  const Eigen::MatrixXd block = part * x * part.transpose();
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < block.rows(); ++i)
    for (Eigen::Index j = 0; j < block.cols(); ++j)
      if (const double sum = 0.5 * (block(i, j) + block(j, i)); sum != 0.0)
        entries.emplace_back(touched[static_cast<std::size_t>(i)], touched[static_cast<std::size_t>(j)], sum);
  SparseMatrix added(k.rows(), k.cols());
  added.setFromTriplets(entries.begin(), entries.end());
  return k + added;
}

/// Compliance F of parts without mass: displacement along the normal of contact i by a unit force at contact j,
/// along n (nn) or along t (nt).
struct Compliance {
  std::vector<std::size_t> contacts;
  Eigen::MatrixXd nn, nt;
  Eigen::VectorXd friction;  ///< the larger of the static and the kinetic coefficient
};

Compliance compliance_of(const Model& model) {
  Compliance f;
  bool any = false;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    if (!model.contacts[k].compliance_split()) continue;
    f.contacts.push_back(k);
    any = any || model.contacts[k].has_friction();
  }
  if (!any) return {};
  std::vector<int> light;
  for (int i = 0; i < model.size(); ++i)
    if (model.dofs[static_cast<std::size_t>(i)].massless) light.push_back(i);
  const SparseMatrix pick = assembly::selection(light, model.size());
  const linear::SymmetricSolver solver(SparseMatrix(pick.transpose() * model.stiffness * pick));
  const auto m = static_cast<Eigen::Index>(f.contacts.size());
  Eigen::MatrixXd n(static_cast<Eigen::Index>(light.size()), m), t = n, response_to_normal = n;
  t.setZero();
  f.friction = Eigen::VectorXd::Zero(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const Contact& c = model.contacts[f.contacts[static_cast<std::size_t>(i)]];
    n.col(i) = pick.transpose() * assembly::dense_vector(c.normal, model.size());
    response_to_normal.col(i) = solver.solve(Vector(n.col(i)));
    if (!c.has_friction()) continue;
    t.col(i) = pick.transpose() * assembly::dense_vector(c.tangent, model.size());
    f.friction[i] = std::max(c.friction.static_, c.friction.kinetic);
  }
  f.nn = response_to_normal.transpose() * n;
  f.nt = response_to_normal.transpose() * t;
  for (Eigen::Index i = 0; i < m; ++i)
    f.nn(i, i) += 1.0 / model.contacts[f.contacts[static_cast<std::size_t>(i)]].normal_stiffness;
  return f;
}

}  // namespace

std::optional<ComplianceSplit> split_compliance(const Scene& scene, const SparseMatrix& dampers,
                                                Model& model) {
  const std::vector<Row> rows = rows_of(scene, model);
  if (rows.empty()) return std::nullopt;
  const SparseMatrix s = shifts(scene, model, rows);
  check_undamped(scene, dampers, rows, s);
  const SparseMatrix ks = model.stiffness * s;
  const Eigen::MatrixXd g(SparseMatrix(s.transpose() * ks));
  const Eigen::VectorXd l = 2.0 * g.cwiseAbs().rowwise().sum();
  for (std::size_t j = 0; j < rows.size(); ++j) {
    Contact& c = model.contacts[rows[j].contact];
    const double stiffness = l[static_cast<Eigen::Index>(j)];
    if (!(stiffness > 0.0))
      refuse_compliance_split(
          scene, rows[j].contact, "law",
          fmt::format(
              "{} has neither mass nor stiffness; give it a mass, or set law = \"compliant\" for the contact",
              rows[j].dof->displacement));
    c.law = compliance_split_law();
    if (rows[j].normal)
      c.normal_stiffness = stiffness;
    else
      c.tangential_stiffness = stiffness;
  }
  const auto m = g.rows();
  const Eigen::MatrixXd x = base::solve_dense(Eigen::MatrixXd(l.asDiagonal()) - 0.5 * (g + g.transpose()),
                                              Eigen::MatrixXd::Identity(m, m));
  model.stiffness = with_block(model.stiffness, ks, x);
  shift_loads(s, ks, x, model);
  ComplianceSplit springs;
  for (const Row& row : rows) springs.rows.push_back({row.contact, row.normal});
  springs.shifts = s;
  const SparseMatrix seen = SparseMatrix(x.sparseView()) * SparseMatrix(ks.transpose());
  SparseMatrix one(model.size(), model.size());
  one.setIdentity();
  springs.displacements = one + SparseMatrix(s * seen);
  return springs;
}

void continue_split(const ComplianceSplit& springs, const Scene& scene, Model& model) {
  if (!scene.initial.saved) return;
  if (model.saved_contacts.empty())
    throw SceneError(scene.initial.place, "run.initial",
                     "contacts.csv of the saved run has no rows at this time, but rigid contacts on parts "
                     "without mass need these rows: choose one of the output times of that run");
  Vector given(springs.shifts.cols());
  for (std::size_t j = 0; j < springs.rows.size(); ++j) {
    const auto [k, normal] = springs.rows[j];
    const Contact& c = model.contacts[k];
    SavedState::FinalContact& left = model.saved_contacts[k];
    double& place = normal ? left.gap.emplace(left.gap.value_or(0.0)) : left.ut;
    const double by = normal ? left.N / c.normal_stiffness : left.T / *c.tangential_stiffness;
    place += by;
    given[static_cast<Eigen::Index>(j)] = by;
  }
  model.u0 += springs.shifts * given;
}

void map_outputs(const ComplianceSplit& springs, Model& model) {
  const SparseMatrix& p = springs.displacements;
  if (model.reduction)
    model.reduction->shapes = p * model.reduction->shapes;
  else
    model.basis = model.basis ? SparseMatrix(p * *model.basis) : p;
}

void check_unique_forces(const Scene& scene, Model& model) {
  const Compliance f = compliance_of(model);
  for (std::size_t i = 0; i < f.contacts.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const double nn = f.nn(at, at), nt = f.nt(at, at), coupled = std::abs(f.friction[at] * nt);
    if (coupled >= nn)
      refuse_compliance_split(
          scene, f.contacts[i], "friction",
          fmt::format(
              "the forces of this contact are not unique while it slides: along the normal, its friction "
              "force displaces it {:.4g} times as far as its normal force does (the forces are unique below "
              "1); expected friction below {:.4g}, mass at the contact, or law = \"compliant\"",
              coupled / nn, nn / std::abs(nt)));
  }
  if (f.contacts.size() < 2) return;
  const Eigen::MatrixXd coupling = f.nt * f.friction.asDiagonal();
  const Eigen::VectorXd mu = base::generalized_eigenvalues(0.5 * (coupling + coupling.transpose()), f.nn);
  const double most = mu.size() > 0 ? mu.cwiseAbs().maxCoeff() : 0.0;
  if (most < 1.0) return;
  model.warnings.push_back(
      fmt::format("the forces of the {} rigid contacts without mass may not be unique while all of them "
                  "slide in the same direction: this run takes one of the solutions; the forces are unique "
                  "with {:.3g} times this friction, with mass at these contacts, or with law = \"compliant\"",
                  f.contacts.size(), 1.0 / most));
}

}  // namespace signorini::model
