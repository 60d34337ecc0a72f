#include "base/lcp.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"

namespace signorini::base {
namespace {

/// Tableau of the system w - M z - d z0 = q in the current basis. Columns: w, z, z0, right-hand side.
class Tableau {
 public:
  Tableau(const Eigen::MatrixXd& M, const Eigen::VectorXd& q, const Eigen::VectorXd& d)
      : n_(q.size()), t_(n_, 2 * n_ + 2), basis_(static_cast<std::size_t>(n_)) {
    t_ << Eigen::MatrixXd::Identity(n_, n_), -M, -d, q;
    for (Eigen::Index i = 0; i < n_; ++i) basis_[static_cast<std::size_t>(i)] = i;
    // Magnitude below which an entry is treated as zero, because of the rounding errors of the elimination.
    zero_ = rounding::many_operations * std::max(1.0, M.cwiseAbs().maxCoeff());
  }

  [[nodiscard]] Eigen::Index artificial() const { return 2 * n_; }
  [[nodiscard]] Eigen::Index complement(Eigen::Index variable) const {
    return variable < n_ ? variable + n_ : variable - n_;
  }
  [[nodiscard]] const std::vector<Eigen::Index>& basis() const { return basis_; }

  /// First pivot row: the row with the most negative ratio of q to d. This pivot makes the start feasible.
  [[nodiscard]] Eigen::Index first_row(const Eigen::VectorXd& d) const {
    Eigen::Index best = 0;
    for (Eigen::Index i = 1; i < n_; ++i)
      if (lexicographically_less(i, d[i], best, d[best])) best = i;
    return best;
  }

  /// Row whose basic variable reaches zero first as the entering variable grows; -1: there is none. In a tie the row of z0 is
  /// returned, so that z0 leaves the basis.
  [[nodiscard]] Eigen::Index blocking_row(Eigen::Index column) const {
    Eigen::Index best = -1;
    for (Eigen::Index i = 0; i < n_; ++i) {
      const double pivot = t_(i, column);
      if (!(pivot > zero_)) continue;
      if (best < 0 || lexicographically_less(i, pivot, best, t_(best, column))) best = i;
    }
    if (best < 0) return best;
    const double least = t_(best, t_.cols() - 1) / t_(best, column);
    for (Eigen::Index i = 0; i < n_; ++i)
      if (basis_[static_cast<std::size_t>(i)] == artificial() && t_(i, column) > zero_ &&
          t_(i, t_.cols() - 1) / t_(i, column) <= least + zero_ * (1.0 + std::abs(least)))
        return i;
    return best;
  }

  /// Exchanges the basic variable of `row` with the variable of `column`; returns the variable that left the basis.
  Eigen::Index pivot(Eigen::Index row, Eigen::Index column) {
    t_.row(row) /= t_(row, column);
    for (Eigen::Index i = 0; i < n_; ++i)
      if (i != row && t_(i, column) != 0.0) {
        const double factor = t_(i, column);
        for (Eigen::Index j = 0; j < t_.cols(); ++j) t_(i, j) = difference(t_(i, j), factor * t_(row, j));
        t_(i, column) = 0.0;
      }
    return std::exchange(basis_[static_cast<std::size_t>(row)], column);
  }

  [[nodiscard]] Eigen::VectorXd solution() const {
    Eigen::VectorXd z = Eigen::VectorXd::Zero(n_);
    for (Eigen::Index i = 0; i < n_; ++i)
      if (const Eigen::Index v = basis_[static_cast<std::size_t>(i)]; v >= n_ && v < artificial())
        z[v - n_] = std::max(0.0, t_(i, t_.cols() - 1));
    return z;
  }

 private:
  /// a - b. A difference of rounding size is set to zero, because rounding would otherwise decide ties.
  [[nodiscard]] static double difference(double a, double b) {
    const double d = a - b;
    return std::abs(d) <= rounding::many_operations * std::max(std::abs(a), std::abs(b)) ? 0.0 : d;
  }
  /// Compares row i divided by pi with row j divided by pj lexicographically: first the right-hand side, then the columns of
  /// w, which contain the inverse of the basis.
  [[nodiscard]] bool lexicographically_less(Eigen::Index i, double pi, Eigen::Index j, double pj) const {
    const Eigen::Index rhs = t_.cols() - 1;
    for (Eigen::Index k = -1; k < n_; ++k) {
      const Eigen::Index column = k < 0 ? rhs : k;
      const double a = t_(i, column) / pi, b = t_(j, column) / pj;
      if (std::abs(a - b) > zero_ * (std::abs(a) + std::abs(b))) return a < b;
    }
    return i < j;
  }

  Eigen::Index n_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> t_;
  std::vector<Eigen::Index> basis_;
  double zero_ = 0.0;
};

/// Computes z again from M and q, with the variables of the final basis. This removes the rounding errors of the pivots.
Eigen::VectorXd refined(const Eigen::MatrixXd& M, const Eigen::VectorXd& q, const Tableau& tableau,
                        const Eigen::VectorXd& z) {
  std::vector<Eigen::Index> active;
  for (const Eigen::Index v : tableau.basis())
    if (v >= q.size() && v < 2 * q.size()) active.push_back(v - q.size());
  if (active.empty()) return z;
  const auto values = solve_regular(M(active, active), -q(active));
  if (!values) return z;
  Eigen::VectorXd result = Eigen::VectorXd::Zero(q.size());
  for (std::size_t i = 0; i < active.size(); ++i)
    result[active[i]] = std::max(0.0, (*values)[static_cast<Eigen::Index>(i)]);
  return result;
}

}  // namespace

std::optional<Eigen::VectorXd> solve_lcp(const Eigen::MatrixXd& M, const Eigen::VectorXd& q) {
  return solve_lcp(M, q, Eigen::VectorXd::Ones(q.size()));
}

std::optional<Eigen::VectorXd> solve_lcp(const Eigen::MatrixXd& M, const Eigen::VectorXd& q,
                                         const Eigen::VectorXd& d) {
  const Eigen::Index n = q.size();
  if (n == 0 || q.minCoeff() >= 0.0) return Eigen::VectorXd::Zero(n);
  Tableau tableau(M, q, d);
  Eigen::Index left = tableau.pivot(tableau.first_row(d), tableau.artificial());
  // Limit of the number of pivots. Without rounding errors, lexicographic pivots never return to an earlier basis.
  const Eigen::Index most = 100 + 50 * n;
  for (Eigen::Index i = 0; i < most; ++i) {
    const Eigen::Index entering = tableau.complement(left);
    const Eigen::Index row = tableau.blocking_row(entering);
    if (row < 0) return std::nullopt;
    left = tableau.pivot(row, entering);
    if (left == tableau.artificial()) return refined(M, q, tableau, tableau.solution());
  }
  return std::nullopt;
}

}  // namespace signorini::base
