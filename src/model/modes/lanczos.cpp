#include "model/modes/lanczos.hpp"

#include <Spectra/MatOp/SparseSymMatProd.h>
#include <Spectra/SymEigsSolver.h>
#include <Spectra/SymGEigsShiftSolver.h>
#include <algorithm>
#include <cmath>
#include <exception>
#include <random>

#include "linear/sparse_cholesky.hpp"
#include "model/assembly/parts.hpp"
#include "model/assembly/springs.hpp"

namespace signorini::modes {
namespace {

constexpr int most_restarts = 300;
constexpr double ritz_tolerance = 1e-12;  // relative residual of a Ritz value

/// Operator interface for Spectra.
class Products {
 public:
  using Scalar = double;

  Products(Eigen::Index n, const Operator& apply) : n_(n), apply_(apply) {}
  [[nodiscard]] Eigen::Index rows() const { return n_; }
  [[nodiscard]] Eigen::Index cols() const { return n_; }
  void set_shift(double /*already in the operator*/) {}
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Eigen::VectorXd>(y, n_) = apply_(Eigen::Map<const Eigen::VectorXd>(x, n_));
  }

 private:
  Eigen::Index n_;
  const Operator& apply_;
};

}  // namespace

double largest_eigenvalue(int n, const Operator& apply, double tolerance) {
  if (n == 1) return apply(Eigen::VectorXd::Ones(1))[0];
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, 1.0, 2.0).normalized();
  if (!(apply(x).norm() > 0.0)) return 0.0;
  try {
    Products op(n, apply);
    Spectra::SymEigsSolver<Products> solver(op, 1, std::min(n, 40));
    solver.init();  // Spectra's fixed start vector: reproducible results
    solver.compute(Spectra::SortRule::LargestAlge, 1000, tolerance);
    if (solver.info() == Spectra::CompInfo::Successful) return solver.eigenvalues()[0];
  } catch (const std::exception&) {
    // With few distinct eigenvalues the iteration ends early, and Spectra's small eigenproblem may then fail.
  }
  double value = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::VectorXd y = apply(x);
    value = y.norm();
    if (!(value > 0.0)) return 0.0;
    x = y / value;
  }
  return value;
}

Vector largest_eigenvalues(int n, int count, const Operator& apply) {
  try {
    Products op(n, apply);
    Spectra::SymEigsSolver<Products> solver(op, count, std::min(n, std::max(2 * count + 1, 60)));
    solver.init();  // Spectra's fixed start vector: reproducible results
    solver.compute(Spectra::SortRule::LargestAlge, most_restarts, ritz_tolerance);
    return solver.eigenvalues();
  } catch (const std::exception&) {
    return Vector(0);
  }
}

base::EigenPairs shift_invert_modes(int count, int width, const SparseMatrix& mass, double shift,
                                    const Operator& inverse) {
  using Mass = Spectra::SparseSymMatProd<double>;
  try {
    Products op(mass.rows(), inverse);
    Mass product(mass);
    Spectra::SymGEigsShiftSolver<Products, Mass, Spectra::GEigsMode::ShiftInvert> solver(op, product, count,
                                                                                         width, -shift);
    solver.init();  // Spectra's fixed start vector: reproducible results
    solver.compute(Spectra::SortRule::LargestMagn, most_restarts, ritz_tolerance,
                   Spectra::SortRule::SmallestAlge);
    if (solver.info() == Spectra::CompInfo::Successful) return {solver.eigenvalues(), solver.eigenvectors()};
  } catch (const std::exception&) {
    // With few distinct eigenvalues the iteration ends early; the caller then uses another method.
  }
  return {Vector(0), Eigen::MatrixXd(mass.rows(), 0)};
}

namespace {

constexpr double dependent_column_limit =
    1e-20;  // smallest x^T M x after orthogonalisation, relative: ten of sixteen digits lost
constexpr double vector_tolerance =
    1e-8;  // residual of a Ritz vector; the error of omega^2 is the square of this value
constexpr int widest_block = 100;
constexpr int most_rounds = 50;

/// Returns the modes of `pairs` with omega^2 < limit and the next mode, in ascending order.
base::EigenPairs sorted(const base::EigenPairs& pairs, double limit) {
  std::vector<Eigen::Index> order;
  for (Eigen::Index j = 0; j < pairs.values.size(); ++j) order.push_back(j);
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return pairs.values[a] < pairs.values[b]; });
  std::size_t kept = 0;
  while (kept < order.size() && pairs.values[order[kept]] < limit) ++kept;
  order.resize(std::min(kept + 1, order.size()));
  return {pairs.values(order), pairs.vectors(Eigen::all, order)};
}

Eigen::Index number_below(const base::EigenPairs& pairs, double limit) {
  return (pairs.values.array() < limit).count();
}

base::EigenPairs join(const base::EigenPairs& a, const base::EigenPairs& b) {
  base::EigenPairs both{Eigen::VectorXd(a.values.size() + b.values.size()),
                        Eigen::MatrixXd(a.vectors.rows(), a.values.size() + b.values.size())};
  both.values << a.values, b.values;
  both.vectors << a.vectors, b.vectors;
  return both;
}

/// Modes from a Krylov space with a single start vector. Free motions are removed from each solution, because rounding errors
/// of free motions would otherwise dominate.
base::EigenPairs lanczos(int count, const linear::SymmetricSolver& solver, const SparseMatrix& mass,
                         const Eigen::MatrixXd& free, double shift, int heavies) {
  const Eigen::MatrixXd inertia = mass * free;
  const Operator inverse = [&](const Eigen::VectorXd& x) {
    Eigen::VectorXd answer = solver.solve(x);
    if (free.cols() > 0) answer -= free * (inertia.transpose() * answer).eval();
    return answer;
  };
  return shift_invert_modes(count, std::min(2 * count + 20, heavies), mass, shift, inverse);
}

/// Modes from the space spanned by X, A X, A^2 X, ..., M-orthogonal to `known`.
class BlockKrylov {
 public:
  BlockKrylov(const linear::SymmetricSolver& solver, const SparseMatrix& mass, const Eigen::MatrixXd& known,
              double shift, int width, unsigned seed)
      : solver_(solver),
        mass_(mass),
        known_(known),
        shift_(shift),
        basis_(mass.rows(), 0),
        images_(mass.rows(), 0) {
    std::mt19937 random(seed);  // fixed seeds: reproducible results
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    Eigen::MatrixXd x(mass.rows(), width);
    for (Eigen::Index j = 0; j < x.cols(); ++j)
      for (Eigen::Index i = 0; i < x.rows(); ++i) x(i, j) = uniform(random);
    next_ = image(x);
  }
  /// Adds a block to the space. Returns false if the space is invariant, or would have more than `greatest` dimensions.
  bool grow(Eigen::Index greatest) {
    Eigen::MatrixXd x = next_;
    const Vector before = (x.transpose() * (mass_ * x)).diagonal();
    deflate(known_, mass_, x);
    deflate(basis_, mass_, x);
    x = orthonormalised(x, before);
    deflate(basis_, mass_, x);
    if (x.cols() == 0 || basis_.cols() + x.cols() > greatest) return false;
    next_ = image(x);
    const Eigen::Index size = basis_.cols();
    basis_.conservativeResize(Eigen::NoChange, size + x.cols());
    images_.conservativeResize(Eigen::NoChange, size + x.cols());
    basis_.rightCols(x.cols()) = x;
    images_.rightCols(x.cols()) = next_;
    return true;
  }
  /// Returns converged Ritz pairs, from the lowest frequency up to the first pair above the limit, or up to the first pair
  /// that has not converged.
  [[nodiscard]] base::EigenPairs modes(double limit) const {
    const Eigen::MatrixXd h = basis_.transpose() * (mass_ * images_);
    const base::EigenPairs ritz = base::symmetric_eigen(0.5 * (h + h.transpose()));
    base::EigenPairs found{Vector(0), Eigen::MatrixXd(basis_.rows(), 0)};
    for (Eigen::Index j = ritz.values.size() - 1; j >= 0 && ritz.values[j] > 0.0; --j) {
      const Vector y = ritz.vectors.col(j), x = basis_ * y, miss = images_ * y - ritz.values[j] * x;
      if (!(std::sqrt(std::max(0.0, miss.dot(mass_ * miss))) <= vector_tolerance * ritz.values[j])) break;
      const double square = 1.0 / ritz.values[j] - shift_;
      found = join(found, {Vector::Constant(1, square), x});
      if (square >= limit) break;
    }
    return found;
  }

 private:
  [[nodiscard]] Eigen::MatrixXd image(const Eigen::MatrixXd& x) const {
    Eigen::MatrixXd y = mass_ * x;
    for (Eigen::Index j = 0; j < y.cols(); ++j) y.col(j) = solver_.solve(y.col(j));
    deflate(known_, mass_, y);
    return y;
  }
  /// M-orthonormal columns that span x. before: x^T M x of each column before deflation; columns that lost nearly all of it
  /// are dropped, because they add no new direction.
  [[nodiscard]] Eigen::MatrixXd orthonormalised(const Eigen::MatrixXd& x, const Vector& before) const {
    Eigen::MatrixXd q(x.rows(), 0);
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      Eigen::MatrixXd v = x.col(j);
      deflate(q, mass_, v);
      const double square = v.col(0).dot(mass_ * v.col(0));
      if (!(square > dependent_column_limit * before[j])) continue;
      q.conservativeResize(Eigen::NoChange, q.cols() + 1);
      q.rightCols(1) = v / std::sqrt(square);
    }
    return q;
  }

  const linear::SymmetricSolver& solver_;
  const SparseMatrix& mass_;
  const Eigen::MatrixXd& known_;
  double shift_;
  Eigen::MatrixXd basis_, images_, next_;
};

}  // namespace

void deflate(const Eigen::MatrixXd& basis, const SparseMatrix& mass, Eigen::MatrixXd& x) {
  for (int round = 0; round < 2 && basis.cols() > 0; ++round)
    x -= (basis * (basis.transpose() * (mass * x)).eval()).eval();
}

base::EigenPairs lowest_modes(int below, double limit, const SparseMatrix& mass,
                              const SparseMatrix& stiffness, const Eigen::MatrixXd& free, double shift) {
  const linear::SymmetricSolver solver(SparseMatrix(stiffness + shift * mass));
  base::EigenPairs found{Vector(0), Eigen::MatrixXd(mass.rows(), 0)};
  if (!solver.ok() || !(solver.smallest_pivot() > 0.0)) return found;
  const int heavies = assembly::degrees_with_mass(mass) - static_cast<int>(free.cols());
  found = sorted(lanczos(below + 1, solver, mass, free, shift, heavies), limit);
  const auto complete = [&] {
    return found.values.size() == below + 1 && number_below(found, limit) == below;
  };
  for (unsigned round = 1; round <= most_rounds && !complete(); ++round) {
    const Eigen::Index old = number_below(found, limit);
    if (old > below) return found;
    Eigen::MatrixXd known(mass.rows(), free.cols() + old);
    known << free, found.vectors.leftCols(old);
    const int missing = below - static_cast<int>(old);
    const int rest = heavies - static_cast<int>(old), width = std::min({missing + 8, widest_block, rest});
    BlockKrylov space(solver, mass, known, shift, width, round);
    const Eigen::Index greatest = std::min(rest, 40 * width);
    base::EigenPairs fresh{Vector(0), Eigen::MatrixXd(mass.rows(), 0)};
    for (bool grows = true; grows && number_below(fresh, limit) == fresh.values.size();) {
      grows = space.grow(greatest);
      fresh = space.modes(limit);
    }
    if (fresh.values.size() == 0) return found;
    found = sorted(join({found.values.head(old), found.vectors.leftCols(old)}, fresh), limit);
  }
  return found;
}

}  // namespace signorini::modes
