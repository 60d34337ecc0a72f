#include "model/modes/lanczos.hpp"

#include <Spectra/MatOp/SparseSymMatProd.h>
#include <Spectra/SymEigsSolver.h>
#include <Spectra/SymGEigsShiftSolver.h>

#include <algorithm>
#include <exception>

namespace signorini {
namespace {

constexpr int most_restarts = 300;
constexpr double converged = 1e-12;  // residual of a Ritz value, relative

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

double greatest_eigenvalue(int n, const Operator& apply, double tolerance) {
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

Vector greatest_eigenvalues(int n, int count, const Operator& apply) {
  try {
    Products op(n, apply);
    Spectra::SymEigsSolver<Products> solver(op, count, std::min(n, std::max(2 * count + 1, 60)));
    solver.init();  // Spectra's fixed start vector: reproducible results
    solver.compute(Spectra::SortRule::LargestAlge, most_restarts, converged);
    return solver.eigenvalues();
  } catch (const std::exception&) {
    return Vector(0);
  }
}

EigenPairs lowest_by_inverse(int count, int width, const SparseMatrix& mass, double shift,
                             const Operator& inverse) {
  using Mass = Spectra::SparseSymMatProd<double>;
  try {
    Products op(mass.rows(), inverse);
    Mass product(mass);
    Spectra::SymGEigsShiftSolver<Products, Mass, Spectra::GEigsMode::ShiftInvert> solver(op, product, count,
                                                                                         width, -shift);
    solver.init();  // Spectra's fixed start vector: reproducible results
    solver.compute(Spectra::SortRule::LargestMagn, most_restarts, converged, Spectra::SortRule::SmallestAlge);
    if (solver.info() == Spectra::CompInfo::Successful) return {solver.eigenvalues(), solver.eigenvectors()};
  } catch (const std::exception&) {
    // With few distinct eigenvalues the iteration ends early: the caller has alternatives.
  }
  return {Vector(0), Eigen::MatrixXd(mass.rows(), 0)};
}

}  // namespace signorini
