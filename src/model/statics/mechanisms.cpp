#include "model/statics/mechanisms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "linear/sparse_cholesky.hpp"
#include "model/assembly/parts.hpp"
#include "model/assembly/springs.hpp"

namespace signorini::statics {
namespace {

constexpr int dense_up_to = 300;

/// D^-1/2; a row of zeros (no stiffness at all) keeps the factor 1.
Vector scaling(const SparseMatrix& k) {
  Vector s = k.diagonal().cwiseAbs();
  for (double& d : s) d = d > 0.0 ? 1.0 / std::sqrt(d) : 1.0;
  return s;
}

/// True if x is a null motion of the scaled matrix a. A zero row is treated as if it had the diagonal 1 of other scaled rows;
/// otherwise rounding in other rows would decide whether its motion is a null motion.
bool is_null(const SparseMatrix& a, const Vector& x) {
  const double bare = (a.diagonal().array() == 0.0).select(x, 0.0).squaredNorm();
  return x.dot(a * x) <= rounding::many_operations * (assembly::term_magnitude(a, x) + bare);
}

/// The lowest `count` eigenvectors of the scaled matrix a (unit diagonal, so that a shift of 1e-14 is below every
/// stiffness that double precision can distinguish from zero).
Eigen::MatrixXd lowest(const SparseMatrix& a, int count) {
  const auto n = static_cast<int>(a.rows());
  SparseMatrix shift(n, n);
  shift.setIdentity();
  const linear::SymmetricSolver solver(SparseMatrix(a + rounding::many_operations * shift));
  std::mt19937 random(1);  // fixed seed: reproducible results
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::MatrixXd x(n, count);
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < n; ++i) x(i, j) = uniform(random);
  for (int round = 0; round < 8; ++round) {
    for (int j = 0; j < count; ++j) x.col(j) = solver.solve(x.col(j));
    x = base::orthonormal(x);
  }
  const Eigen::MatrixXd projected = x.transpose() * (a * x);
  return x * base::symmetric_eigen(0.5 * (projected + projected.transpose())).vectors;
}

/// True if no eigenvalue is near the limit of is_null(), many_operations |x|^T |a| |x| / |x|^2. The test: a
/// has no negative pivot after ten times this limit is subtracted; the error of the factorisation is below
/// the limit.
bool surely_constrained(const SparseMatrix& a) {
  const auto n = a.rows();
  const double most = (a.cwiseAbs() * Vector::Ones(n)).maxCoeff();
  SparseMatrix one(n, n);
  one.setIdentity();
  const linear::SymmetricSolver solver(SparseMatrix(a - (10.0 * rounding::many_operations * most) * one));
  return solver.ok() && solver.smallest_pivot() > 0.0;
}

Eigen::MatrixXd null_motions_of_part(const SparseMatrix& k) {
  const auto n = static_cast<int>(k.rows());
  const Vector s = scaling(k);
  const SparseMatrix a = s.asDiagonal() * k * s.asDiagonal();
  if (surely_constrained(a)) return Eigen::MatrixXd(n, 0);
  for (int count = std::min(n, 8);; count = std::min(n, 4 * count)) {
    const bool all = n <= dense_up_to || count == n;
    const Eigen::MatrixXd candidates =
        all ? base::symmetric_eigen(Eigen::MatrixXd(a)).vectors : lowest(a, count);
    Eigen::Index found = 0;
    while (found < candidates.cols() && is_null(a, candidates.col(found))) ++found;
    if (all || found < candidates.cols()) return s.asDiagonal() * candidates.leftCols(found);
  }
}

Eigen::MatrixXd null_motions_by_parts(const SparseMatrix& k) {
  const assembly::Parts parts({&k});
  if (parts.count() == 1) return null_motions_of_part(k);
  std::vector<Eigen::MatrixXd> own;
  Eigen::Index found = 0;
  for (const assembly::Part& part : parts) {
    own.push_back(null_motions_of_part(part.matrix(k)));
    found += own.back().cols();
  }
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(k.rows(), found);
  Eigen::Index at = 0;
  auto motion = own.begin();
  for (const assembly::Part& part : parts) {
    for (Eigen::Index j = 0; j < motion->cols(); ++j, ++at)
      for (Eigen::Index i = 0; i < motion->rows(); ++i)
        motions(part.dofs()[static_cast<std::size_t>(i)], at) = (*motion)(i, j);
    ++motion;
  }
  return motions;
}

}  // namespace

bool may_have_null_motions(const SparseMatrix& k) {
  // A null motion leaves a pivot of some n eps. A pivot of a slender structure may also be below this limit; it only causes an
  // unnecessary search.
  constexpr double certainly_held = 1e-9;
  const Vector s = scaling(k);
  const linear::SymmetricSolver solver(SparseMatrix(s.asDiagonal() * k * s.asDiagonal()));
  return !solver.ok() || !(solver.smallest_pivot() > certainly_held);
}

Eigen::MatrixXd null_motions(const SparseMatrix& k) {
  if (k.rows() == 0) return Eigen::MatrixXd(0, 0);
  return null_motions_by_parts(k);
}

namespace {

constexpr double belongs = 1e-3;  // relative to a motion: smaller remainders are errors of null motions

/// Translations along x and y, and the rotation about the centre, on the given degrees of freedom.
std::array<Vector, 3> rigid_motions(const assembly::DofMap& map, const std::vector<int>& dofs) {
  std::array<Vector, 3> rigid;
  rigid.fill(Vector::Zero(map.size()));
  double x = 0.0, y = 0.0, count = 0.0;
  for (const int i : dofs) {
    const auto node = static_cast<std::size_t>(map.locations[static_cast<std::size_t>(i)].first);
    x += map.mesh.nodes[node].x;
    y += map.mesh.nodes[node].y;
    count += 1.0;
  }
  for (const int i : dofs) {
    const auto [number, component] = map.locations[static_cast<std::size_t>(i)];
    const element::MeshNode& node = map.mesh.nodes[static_cast<std::size_t>(number)];
    if (component < 2) rigid[static_cast<std::size_t>(component)][i] = 1.0;
    rigid[2][i] = component == 0 ? -(node.y - y / count) : component == 1 ? node.x - x / count : 1.0;
  }
  return rigid;
}

}  // namespace

Eigen::MatrixXd simple_motions(const Eigen::MatrixXd& motions, const assembly::DofMap& map) {
  std::vector<int> all(static_cast<std::size_t>(map.size()));
  std::iota(all.begin(), all.end(), 0);
  return simple_motions(motions, map, all);
}

Eigen::MatrixXd simple_motions(const Eigen::MatrixXd& motions, const assembly::DofMap& map,
                               const std::vector<int>& dofs) {
  if (map.is_matrix_scene() || motions.cols() < 2) return motions;
  const Eigen::MatrixXd q = base::orthonormal(motions);
  Eigen::MatrixXd found(q.cols(), 0), basis(q.cols(), 0);  // coordinates in q; their orthonormal basis
  for (const Vector& rigid : rigid_motions(map, dofs)) {
    const Eigen::VectorXd c = q.transpose() * rigid;
    if (!((rigid - q * c).norm() <= belongs * rigid.norm()) || rigid.norm() == 0.0) continue;
    const Eigen::VectorXd rest = c - basis * (basis.transpose() * c);
    if (!(rest.norm() > belongs * c.norm())) continue;
    found.conservativeResize(Eigen::NoChange, found.cols() + 1);
    found.rightCols(1) = c;
    basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
    basis.rightCols(1) = rest.normalized();
  }
  if (found.cols() == 0) return motions;
  Eigen::MatrixXd result(q.rows(), q.cols());
  result.leftCols(found.cols()) = q * found;
  if (found.cols() < q.cols())
    result.rightCols(q.cols() - found.cols()) = q * base::orthogonal_complement(found);
  return result;
}

Mechanisms::Mechanisms(const SparseMatrix& k, const std::vector<ConstraintRow>& rows,
                       const std::vector<bool>& loose) {
  std::vector<assembly::LineSpring> stay;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (loose[i])
      rows_.push_back(i);
    else
      stay.push_back({rows[i].form, rows[i].stiffness});
  if (rows_.empty()) return;
  const SparseMatrix rest = assembly::with_springs(k, stay);
  if (may_have_null_motions(rest)) motions_ = null_motions(rest);
  if (motions_.cols() == 0) return;
  root_.resize(static_cast<Eigen::Index>(rows_.size()));
  moves_.resize(root_.size(), motions_.cols());
  for (Eigen::Index i = 0; i < root_.size(); ++i) {
    const ConstraintRow& row = rows[rows_[static_cast<std::size_t>(i)]];
    root_[i] = std::sqrt(row.stiffness);
    for (Eigen::Index j = 0; j < motions_.cols(); ++j)
      moves_(i, j) = root_[i] * row.form.dot(motions_.col(j));
  }
  q_ = base::orthonormal(moves_);
}

std::pair<Vector, Vector> Mechanisms::response(const ConstraintRows& held, std::size_t row, double r) const {
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
  u += motions_ * base::least_squares(moves_, free);
  return {std::move(u), std::move(forces)};
}

}  // namespace signorini::statics
