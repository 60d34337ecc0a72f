#include "model/modes/lanczos.hpp"

#include <Spectra/SymEigsSolver.h>

#include <algorithm>
#include <stdexcept>

namespace signorini {
namespace {

/// What Spectra asks of an operator.
class Operator {
 public:
  using Scalar = double;

  Operator(int n, const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply)
      : n_(n), apply_(apply) {}
  [[nodiscard]] Eigen::Index rows() const { return n_; }
  [[nodiscard]] Eigen::Index cols() const { return n_; }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Eigen::VectorXd>(y, n_) = apply_(Eigen::Map<const Eigen::VectorXd>(x, n_));
  }

 private:
  Eigen::Index n_;
  const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply_;
};

}  // namespace

double greatest_eigenvalue(int n, const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply,
                           double tolerance) {
  if (n == 1) return apply(Eigen::VectorXd::Ones(1))[0];
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, 1.0, 2.0).normalized();
  if (!(apply(x).norm() > 0.0)) return 0.0;
  try {
    Operator op(n, apply);
    Spectra::SymEigsSolver<Operator> solver(op, 1, std::min(n, 40));
    solver.init();  // Spectra's own fixed start vector: the same scene gives the same answer
    solver.compute(Spectra::SortRule::LargestAlge, 1000, tolerance);
    if (solver.info() == Spectra::CompInfo::Successful) return solver.eigenvalues()[0];
  } catch (const std::runtime_error&) {
    // Few different eigenvalues end its iteration early, and its small matrix may then not be one to solve.
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

}  // namespace signorini
