#include "model/modes/frequencies.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "linear/sparse_cholesky.hpp"
#include "model/assembly/parts.hpp"
#include "model/assembly/springs.hpp"
#include "model/modes/constrained_structure.hpp"
#include "model/modes/stability.hpp"
#include "model/statics/mechanisms.hpp"

namespace signorini::modes {
namespace {

// Null motions whose inertia is below this fraction of the largest one have no mass.
constexpr double without_mass = 1e-12;
// Values 1/omega^2 below this fraction of the largest one are rounding errors of motions without mass.
constexpr double massless_share = 1e-13;
constexpr double negligible_entry = 1e-9;  // smaller entries of a motion, relative to its largest, are zero
// Shift of omega^2 if there are free motions, relative to the largest K_ii/M_ii: half of the digits remain.
constexpr double shift_of_free = 1e-8;
// Limit of the relative change of omega^2 in one round, with shifts.
constexpr double shifted_tolerance = 1e-11;
// Limits of the change of values() in one round, without shifts: relative to the largest value, and to each value.
constexpr double largest_value_tolerance = 1e-12, each_value_tolerance = 1e-9;

NaturalMode mode_of(double omega, const Eigen::VectorXd& x, const SparseMatrix& mass,
                    const SparseMatrix& damping) {
  const double m = x.dot(mass * x);
  return {omega, m > 0.0 ? x.dot(damping * x) / (2.0 * omega * m) : 0.0};
}

/// The null motions of K. The basis is chosen so that each motion either has mass or has none.
struct FreeMotions {
  Eigen::MatrixXd heavy, massless;
  int unstable = 0;  ///< number of unstable motions in `heavy`
};

int count_unstable(const SparseMatrix& k, const Eigen::MatrixXd& motions) {
  if (motions.cols() == 0) return 0;
  const Eigen::MatrixXd x = motions * base::symmetric_eigen(motions.transpose() * (k * motions)).vectors;
  int count = 0;
  while (count < x.cols() && has_negative_energy(k, x.col(count))) ++count;
  return count;
}

FreeMotions free_motions(const SparseMatrix& k, const SparseMatrix& mass) {
  Eigen::MatrixXd null = statics::null_motions(k);
  for (Eigen::Index j = 0; j < null.cols(); ++j) null.col(j).normalize();
  if (null.cols() == 0) return {null, null, 0};
  const Eigen::MatrixXd moved = mass * null;
  const base::EigenPairs pairs = base::symmetric_eigen(null.transpose() * moved);
  const double greatest = pairs.values[pairs.values.size() - 1];
  Eigen::Index without = 0;
  while (without < pairs.values.size() && !(pairs.values[without] > without_mass * greatest)) ++without;
  const Eigen::MatrixXd heavy = null * pairs.vectors.rightCols(null.cols() - without);
  return {heavy, null * pairs.vectors.leftCols(without), count_unstable(k, heavy)};
}

/// Number of motions with mass if the forms F are fixed: degrees of freedom with mass - rank F + rank of F on the
/// massless degrees of freedom.
int motions_with_mass(const SparseMatrix& mass, const std::vector<Combination>& fixed) {
  const int heavy = assembly::degrees_with_mass(mass);
  if (fixed.empty()) return heavy;
  const auto n = static_cast<int>(mass.rows());
  Eigen::MatrixXd all = form_columns(fixed, n), light = all;
  for (int i = 0; i < n; ++i)
    if (mass.coeff(i, i) > 0.0) light.row(i).setZero();
  return heavy - base::rank(all) + base::rank(light);
}

Frequencies dense(const SparseMatrix& mass, const SparseMatrix& damping, const SparseMatrix& k,
                  const std::vector<Combination>& fixed, int count) {
  const auto n = static_cast<int>(k.rows());
  Eigen::MatrixXd q = Eigen::MatrixXd::Identity(n, n);
  if (!fixed.empty()) q = base::orthogonal_complement(form_columns(fixed, n));
  if (q.cols() == 0) return {};
  SparseMatrix m = mass, stiff = k;
  if (!fixed.empty()) {
    m = restricted(mass, q);
    stiff = restricted(k, q);
  }
  const FreeMotions free = free_motions(stiff, m);
  Frequencies result;
  result.free_motions = static_cast<int>(free.heavy.cols());
  result.unstable = free.unstable;
  if (free.unstable > 0) {
    // Motions of negative energy are not eigenvectors, so the other modes are not M-orthogonal to them.
    const base::EigenPairs all = base::generalized_eigen(stiff, m);
    for (Eigen::Index j = result.free_motions; j < all.values.size() && count > 0; ++j, --count)
      result.modes.push_back(mode_of(std::sqrt(all.values[j]), q * all.vectors.col(j), mass, damping));
    return result;
  }
  Eigen::MatrixXd across(m.rows(), free.heavy.cols() + free.massless.cols());
  across << m * free.heavy, free.massless;
  for (Eigen::Index j = 0; j < across.cols(); ++j) across.col(j).normalize();
  Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(m.rows(), m.rows());
  if (across.cols() > 0) rest = base::orthogonal_complement(across);
  if (rest.cols() == 0) return result;
  const base::EigenPairs pairs =
      base::generalized_eigen(rest.transpose() * (m * rest), rest.transpose() * (stiff * rest));
  // Modes beyond this number have no mass; their values are rounding errors.
  const int with_mass = motions_with_mass(mass, fixed) - result.free_motions;
  count = std::min(count, with_mass);
  for (Eigen::Index j = pairs.values.size() - 1; j >= 0 && count > 0; --j, --count) {
    if (!(pairs.values[j] > massless_share * pairs.values[pairs.values.size() - 1])) break;
    result.modes.push_back(
        mode_of(1.0 / std::sqrt(pairs.values[j]), q * (rest * pairs.vectors.col(j)), mass, damping));
  }
  return result;
}

/// Fixes motions that have neither mass nor stiffness; their degrees of freedom belong to no other motion.
SparseMatrix fix_massless_null_motions(const SparseMatrix& k, const Eigen::MatrixXd& motions) {
  std::vector<Combination> forms;
  for (Eigen::Index j = 0; j < motions.cols(); ++j) {
    Combination form;
    const double size = motions.col(j).cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < motions.rows(); ++i)
      if (std::abs(motions(i, j)) > negligible_entry * size)
        form.terms.emplace_back(static_cast<int>(i), motions(i, j));
    forms.push_back(std::move(form));
  }
  return with_constraint_springs(k, forms);
}

/// Shifted inverse iteration with a subspace. The lowest frequencies of long structures are so close together
/// (a chain of n masses on springs: relative distance 1/n^2) that K^-1 hardly separates them. Once rough values
/// are known, a shift just below the lowest frequency separates them.
class Subspace {
 public:
  Subspace(const SparseMatrix& k, const SparseMatrix& mass, const std::vector<Combination>& fixed,
           double shift, int size)
      : k_(k), mass_(mass), fixed_(fixed), shift_(shift), solver_(SparseMatrix(k + shift * mass), fixed) {
    std::mt19937 random(1);  // fixed seed: reproducible results
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    x_.resize(k.rows(), size);
    for (Eigen::Index j = 0; j < x_.cols(); ++j)
      for (Eigen::Index i = 0; i < x_.rows(); ++i) x_(i, j) = uniform(random);
  }

  /// Performs one round of the iteration. Returns false if K + shift M is not positive definite on the subspace.
  bool iterate() {
    for (Eigen::Index j = 0; j < x_.cols(); ++j) x_.col(j) = solver_.solve(mass_ * x_.col(j));
    x_ = base::orthonormal(x_);
    const Eigen::MatrixXd kx = k_ * x_, mx = mass_ * x_;
    const base::EigenPairs pairs =
        base::generalized_eigen(x_.transpose() * mx, x_.transpose() * (kx + shift_ * mx));
    if (pairs.values.size() < x_.cols()) return false;
    values_ = pairs.values;
    x_ = (x_ * pairs.vectors).eval();
    return true;
  }
  /// 1 / (omega^2 + shift), ascending: the lowest frequencies last.
  [[nodiscard]] const Eigen::VectorXd& values() const { return values_; }
  /// The motions, in the order of values().
  [[nodiscard]] const Eigen::MatrixXd& motions() const { return x_; }
  /// The `wanted` lowest omega^2, the smallest one last.
  [[nodiscard]] Eigen::VectorXd squares(Eigen::Index wanted) const {
    return (values_.tail(wanted).cwiseInverse().array() - shift_).matrix();
  }
  /// Rounding error of the lowest omega^2.
  [[nodiscard]] double noise() const {
    const Vector lowest = x_.col(x_.cols() - 1);
    return rounding::eps * assembly::term_magnitude(k_, lowest) / lowest.dot(mass_ * lowest);
  }
  /// Moves the shift to just below the lowest omega^2; the distance is about the range of the `wanted` lowest values.
  void approach(Eigen::Index wanted) {
    const Eigen::VectorXd found = squares(wanted);
    const double lowest = found[wanted - 1];
    double gap = std::max(found[0] - lowest, 1e4 * noise());
    for (int tries = 0; tries < 12 && gap - lowest < shift_; ++tries, gap *= 8.0) {
      ConstrainedStructure closer(SparseMatrix(k_ + (gap - lowest) * mass_), fixed_);
      if (!closer.definite())
        continue;  // the shift is above the lowest omega^2, because Ritz values have errors
      shift_ = gap - lowest;
      solver_ = std::move(closer);
      return;
    }
  }

 private:
  const SparseMatrix &k_, &mass_;
  const std::vector<Combination>& fixed_;
  double shift_;
  ConstrainedStructure solver_;
  Eigen::MatrixXd x_;
  Eigen::VectorXd values_;
};

Frequencies sparse(const SparseMatrix& mass, const SparseMatrix& damping, const SparseMatrix& k0,
                   const std::vector<Combination>& fixed, int count) {
  const auto n = static_cast<int>(k0.rows());
  const FreeMotions free = free_motions(with_constraint_springs(k0, fixed), mass);
  const SparseMatrix k = free.massless.cols() > 0 ? fix_massless_null_motions(k0, free.massless) : k0;
  Frequencies result;
  result.free_motions = static_cast<int>(free.heavy.cols());
  result.unstable = free.unstable;
  const int size = std::min(result.free_motions + count + 11, motions_with_mass(mass, fixed));
  if (size <= 0) return result;

  // (K + shift M) x = (omega^2 + shift) M x: regular even with rigid-body motions.
  double shift = 0.0;
  if (result.free_motions > 0)
    for (int i = 0; i < n; ++i)
      if (mass.coeff(i, i) > 0.0) shift = std::max(shift, shift_of_free * k.coeff(i, i) / mass.coeff(i, i));
  Subspace space(k, mass, fixed, shift, size);
  const int wanted = std::min(size, result.free_motions + count);
  const bool approaches = result.free_motions == 0;
  Eigen::VectorXd before = Eigen::VectorXd::Zero(wanted);
  for (int round = 1; round <= 200; ++round) {
    if (!space.iterate()) return result;
    const Eigen::VectorXd now = approaches ? space.squares(wanted) : space.values().tail(wanted);
    const Eigen::ArrayXd change = (now - before).cwiseAbs().array();
    before = now;
    if (approaches) {
      if ((change <= shifted_tolerance * now.cwiseAbs().array() + 4.0 * space.noise()).all()) break;
      if (round % 4 == 0) space.approach(std::min(size, std::max(wanted, 5)));
    } else if (change.maxCoeff() <= largest_value_tolerance * now.cwiseAbs().maxCoeff() &&
               (change <= each_value_tolerance * now.array()).all()) {
      break;
    }
  }
  const Eigen::MatrixXd& x = space.motions();
  for (int j = size - 1 - result.free_motions; j >= size - wanted; --j) {
    const Eigen::VectorXd shape = x.col(j);
    const double omega_squared = shape.dot(k * shape) / shape.dot(mass * shape);
    if (omega_squared > 0.0) result.modes.push_back(mode_of(std::sqrt(omega_squared), shape, mass, damping));
  }
  return result;
}

}  // namespace

Frequencies lowest_frequencies(const SparseMatrix& mass, const SparseMatrix& damping,
                               const SparseMatrix& stiffness, const ContactConstraints& holding, int count) {
  if (mass.rows() == 0) return {};
  const SparseMatrix k = assembly::with_springs(stiffness, holding.springs);
  if (mass.rows() <= dense_up_to) return dense(mass, damping, k, holding.fixed, count);
  Frequencies all;
  for (const assembly::Part& part : assembly::Parts({&mass, &k}, holding.fixed)) {
    const SparseMatrix m = part.matrix(mass), c = part.matrix(damping), own = part.matrix(k);
    const std::vector<Combination> fixed = part.forms(holding.fixed);
    const Frequencies found =
        part.size() <= dense_up_to ? dense(m, c, own, fixed, count) : sparse(m, c, own, fixed, count);
    all.free_motions += found.free_motions;
    all.unstable += found.unstable;
    all.modes.insert(all.modes.end(), found.modes.begin(), found.modes.end());
  }
  std::stable_sort(all.modes.begin(), all.modes.end(),
                   [](const NaturalMode& a, const NaturalMode& b) { return a.omega < b.omega; });
  if (static_cast<int>(all.modes.size()) > count) all.modes.resize(static_cast<std::size_t>(count));
  return all;
}

ContactConstraints constrain_normals(const std::vector<Contact>& contacts) {
  ContactConstraints holding;
  for (const Contact& c : contacts) holding.add_normal(c);
  return holding;
}

namespace {

constexpr double nearest = 1e-9, farthest = 1e-5;  // range of alternative shifts, relative to omega^2
constexpr double accurate = 1e-6;  // backward error of a factorisation whose pivot signs are reliable

/// Checks a factorisation by a trial solution: pivots are not chosen by size, so an unlucky shift may lose all digits.
bool is_accurate(const linear::SymmetricSolver& solver, const SparseMatrix& a) {
  if (!solver.ok()) return false;
  const Vector b = a.diagonal().cwiseAbs();
  const Vector x = solver.solve(b);
  if (!x.allFinite()) return false;
  const Vector size = a.cwiseAbs() * x.cwiseAbs() + b;
  return ((a * x - b).cwiseAbs().array() <= accurate * size.array()).all();
}

}  // namespace

int count_modes_below(const SparseMatrix& mass, const SparseMatrix& stiffness, double square) {
  for (double beyond = 0.0; beyond <= farthest; beyond = beyond > 0.0 ? 10.0 * beyond : nearest) {
    const SparseMatrix a = stiffness - (1.0 + beyond) * square * mass;
    const linear::SymmetricSolver solver(a);
    if (is_accurate(solver, a)) return solver.negative_pivots();
  }
  return -1;
}

}  // namespace signorini::modes
