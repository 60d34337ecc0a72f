#include "model/modes/stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "linear/sparse_cholesky.hpp"
#include "model/assembly/parts.hpp"
#include "model/assembly/springs.hpp"
#include "model/modes/constrained_structure.hpp"
#include "model/modes/lanczos.hpp"
#include "model/statics/mechanisms.hpp"

namespace signorini::modes {
namespace {

// Values nu below this fraction of the largest |nu| are rounding errors of motions without geometric stiffness.
constexpr double no_factor = 1e-12;
constexpr double least_share = 1e-7;  // smallest s: below it K + s K_g equals K in half of the digits

/// K and K_g without their common null motions.
struct Pencil {
  SparseMatrix elastic, geometric;

  [[nodiscard]] SparseMatrix at(double s) const { return elastic + s * geometric; }
};

/// Fixes the common null motions that respect the constraints, each at its largest entry. Null motions have no
/// energy, so fixing them does not change the load factors.
Pencil without_common_null_motions(const SparseMatrix& loose, const SparseMatrix& geometric,
                                   const std::vector<Combination>& fixed) {
  const SparseMatrix elastic = fixed.empty() ? loose : with_constraint_springs(loose, fixed);
  Vector size = elastic.diagonal().cwiseAbs() + geometric.diagonal().cwiseAbs();
  for (double& d : size) d = d > 0.0 ? d : 1.0;
  // K_g D^-1 K_g has the null motions of K_g and is positive semidefinite.
  const SparseMatrix square = geometric * SparseMatrix(size.cwiseInverse().asDiagonal() * geometric);
  const auto greatest = [&](const SparseMatrix& a) {
    return a.rows() == 0 ? 0.0 : a.diagonal().cwiseQuotient(size).cwiseAbs().maxCoeff();
  };
  const double of_square = greatest(square);
  const SparseMatrix both =
      of_square > 0.0 ? SparseMatrix(elastic + std::max(greatest(elastic), 1e-300) / of_square * square)
                      : elastic;
  Eigen::MatrixXd null = statics::null_motions(greatest(elastic) > 0.0 ? both : square);
  Pencil result{loose, geometric};
  for (Eigen::Index j = 0; j < null.cols(); ++j) {
    Eigen::Index at = 0;
    null.col(j).cwiseAbs().maxCoeff(&at);
    for (Eigen::Index i = j + 1; i < null.cols(); ++i) null.col(i) -= null(at, i) / null(at, j) * null.col(j);
    result.elastic.coeffRef(at, at) += size[at];
  }
  return result;
}

bool is_definite(const SparseMatrix& a) { return statics::null_motions(a).cols() == 0; }

/// A shift s, and the positive definite matrix K + s K_g plus springs along the fixed forms.
struct Shift {
  double s = 1.0;
  SparseMatrix matrix;
};

std::optional<Shift> find_shift(const Pencil& pencil, const std::vector<Combination>& fixed) {
  const auto try_at = [&](double s) -> std::optional<Shift> {
    const SparseMatrix a = pencil.at(s);
    if (fixed.empty()) return is_definite(a) ? std::optional(Shift{s, a}) : std::nullopt;
    const SparseMatrix gripped = with_constraint_springs(a, fixed), grips = gripped - a;
    for (const double firm : {1.0, 1e3, 1e6})
      if (const SparseMatrix all = a + firm * grips; is_definite(all)) return Shift{s, all};
    return std::nullopt;
  };
  for (const double s : {1.0, 0.0})
    if (auto found = try_at(s)) return found;
  for (double s = 0.5; s > least_share; s *= 0.125)
    if (auto found = try_at(s)) return found;
  return std::nullopt;
}

/// Returns the load factors s + 1/nu > s, ascending. nu: eigenvalues, unsorted; size: a known magnitude of eigenvalues that nu
/// does not contain.
std::vector<double> factors_of(double s, const Vector& nu, double size = 0.0) {
  std::vector<double> factors;
  const double most = nu.size() == 0 ? size : std::max(size, nu.cwiseAbs().maxCoeff());
  for (const double value : nu)
    if (value > no_factor * most) factors.push_back(s + 1.0 / value);
  std::sort(factors.begin(), factors.end());
  return factors;
}

std::vector<double> dense_factors(const SparseMatrix& elastic, const SparseMatrix& geometric,
                                  const std::vector<Combination>& fixed) {
  const auto n = static_cast<int>(elastic.rows());
  Pencil own{elastic, geometric};
  if (!fixed.empty()) {
    const Eigen::MatrixXd q = base::orthogonal_complement(form_columns(fixed, n));
    if (q.cols() == 0) return {};
    own = {restricted(elastic, q), restricted(geometric, q)};
  }
  const Pencil pencil = without_common_null_motions(own.elastic, own.geometric, {});
  const auto shift = find_shift(pencil, {});
  if (!shift) return {0.0};
  return factors_of(shift->s, base::generalized_eigenvalues(-Eigen::MatrixXd(pencil.geometric),
                                                            Eigen::MatrixXd(shift->matrix)));
}

/// Magnitude of the largest eigenvalues of an operator, by some steps of the power method; at most the largest one.
double eigenvalue_size(Eigen::Index n, const Operator& apply) {
  constexpr int steps = 20;
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) y[i] = std::sin(static_cast<double>(i + 1));  // any vector
  double size = 0.0;
  for (int i = 0; i < steps; ++i) {
    y.normalize();
    y = apply(y);
    size = std::max(size, y.norm());
    if (!(size > 0.0)) break;
  }
  return size;
}

std::vector<double> sparse_factors(const SparseMatrix& elastic, const SparseMatrix& geometric,
                                   const std::vector<Combination>& fixed, int count) {
  const auto n = static_cast<int>(elastic.rows());
  const Pencil pencil = without_common_null_motions(elastic, geometric, fixed);
  const auto shift = find_shift(pencil, fixed);
  if (!shift) return {0.0};
  const linear::CholeskyFactor factor(shift->matrix);
  if (!factor.ok()) return {0.0};
  Eigen::MatrixXd across = form_columns(fixed, n);  // orthonormal columns that span F^-1 T
  for (Eigen::Index j = 0; j < across.cols(); ++j) across.col(j) = factor.solve_factor(Vector(across.col(j)));
  if (across.cols() > 0) across = base::orthonormal(across);
  const auto along = [&](const Vector& y) -> Vector { return y - across * (across.transpose() * y); };
  const Operator apply = [&](const Eigen::VectorXd& y) -> Eigen::VectorXd {
    return along(factor.solve_factor(Vector(-(pencil.geometric * factor.solve_transposed_factor(along(y))))));
  };
  // In tension the largest eigenvalues are zeros with rounding errors, which are relative to the most negative one.
  return factors_of(shift->s, largest_eigenvalues(n, std::min(count, n - 1), apply),
                    eigenvalue_size(n, apply));
}

}  // namespace

std::vector<double> load_factors(const SparseMatrix& elastic, const SparseMatrix& geometric,
                                 const ContactConstraints& holding, int count) {
  if (elastic.rows() == 0 || geometric.nonZeros() == 0) return {};
  const SparseMatrix k = assembly::with_springs(elastic, holding.springs);
  std::vector<double> factors;
  if (elastic.rows() <= dense_up_to) {
    factors = dense_factors(k, geometric, holding.fixed);
  } else {
    for (const assembly::Part& part : assembly::Parts({&k, &geometric}, holding.fixed)) {
      const SparseMatrix own = part.matrix(k), forces = part.matrix(geometric);
      const std::vector<Combination> fixed = part.forms(holding.fixed);
      const std::vector<double> found = part.size() <= dense_up_to
                                            ? dense_factors(own, forces, fixed)
                                            : sparse_factors(own, forces, fixed, count);
      factors.insert(factors.end(), found.begin(), found.end());
    }
    std::sort(factors.begin(), factors.end());
  }
  if (static_cast<int>(factors.size()) > count) factors.resize(static_cast<std::size_t>(count));
  return factors;
}

bool has_negative_energy(const SparseMatrix& k, const Vector& motion) {
  return motion.dot(k * motion) < -rounding::many_operations * assembly::term_magnitude(k, motion);
}

namespace {

constexpr double no_inertia = 1e-14;  // smaller inertias, relative to the terms of x.Mx, are rounding errors
constexpr double converged_rate_change =
    1e-9;  // relative change of the rate at which the iteration has converged

std::optional<Growth> growth_of_whole(const SparseMatrix& k, const SparseMatrix& mass) {
  Eigen::MatrixXd null = statics::null_motions(k);  // includes motions of negative energy
  if (null.cols() == 0) return std::nullopt;
  for (Eigen::Index j = 0; j < null.cols(); ++j) null.col(j).normalize();
  Growth growth;
  growth.motion = null * base::symmetric_eigen(null.transpose() * (k * null)).vectors.col(0);
  if (!has_negative_energy(k, growth.motion)) return std::nullopt;

  // Inverse iteration on K + s M with s above the largest sigma^2 found so far. Every Rayleigh quotient is a rate that
  // some motion reaches, so an early end can only underestimate the rate.
  Vector x = growth.motion;
  for (int round = 0; round < 100; ++round) {
    const double energy = x.dot(k * x), inertia = x.dot(mass * x);
    if (!(inertia > no_inertia * assembly::term_magnitude(mass, x)) || !std::isfinite(energy / inertia)) {
      growth.rate = std::numeric_limits<double>::infinity();
      return growth;
    }
    const double rate = std::sqrt(std::max(-energy / inertia, 0.0));
    const bool settled = rate <= (1.0 + converged_rate_change) * growth.rate;
    if (rate > growth.rate) growth = {rate, x};
    if (settled) break;
    const linear::SymmetricSolver solver(SparseMatrix(k + 1.5 * growth.rate * growth.rate * mass));
    if (!solver.ok()) break;
    x = solver.solve(mass * x).normalized();
  }
  return growth;
}

}  // namespace

std::optional<Growth> fastest_growth(const SparseMatrix& k, const SparseMatrix& mass) {
  const assembly::Parts parts({&k, &mass});
  if (parts.count() == 1) return growth_of_whole(k, mass);
  std::optional<Growth> fastest;
  for (const assembly::Part& part : parts) {
    const std::optional<Growth> own = growth_of_whole(part.matrix(k), part.matrix(mass));
    if (!own || (fastest && own->rate <= fastest->rate)) continue;
    fastest = Growth{own->rate, Vector::Zero(k.rows())};
    fastest->motion(part.dofs()) = own->motion;
  }
  return fastest;
}

}  // namespace signorini::modes
