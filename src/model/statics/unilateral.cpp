#include "model/statics/unilateral.hpp"

#include <algorithm>
#include <cmath>

#include "model/assembly/springs.hpp"

namespace signorini {
namespace {

constexpr double no_stiffness = 1e-12;  // relative to the diagonal: makes the matrix regular, and is
                                        // negligible beside contact springs

std::vector<bool> closed_at(const StaticProblem& problem, const Vector& u) {
  std::vector<bool> closed(problem.contacts.size(), false);
  for (std::size_t k = 0; k < closed.size(); ++k)
    closed[k] = problem.is_support(k) && problem.gap(k, u) < 0.0;
  return closed;
}

/// Slope of the energy at u along d; k0 is the matrix without contacts.
double slope(const StaticProblem& problem, const SparseMatrix& k0, const Vector& u, const Vector& d) {
  double s = d.dot(k0 * u - problem.load);
  for (std::size_t k = 0; k < problem.contacts.size(); ++k)
    if (problem.is_support(k))
      s += problem.normal_stiffness(k) * std::min(problem.gap(k, u), 0.0) * problem.contacts[k].normal.dot(d);
  return s;
}

/// The step a > 0 that minimises the energy along d. The slope is piecewise linear in a and increasing, with kinks
/// where a contact opens or closes.
double best_step(const StaticProblem& problem, const SparseMatrix& k0, const Vector& u, const Vector& d) {
  std::vector<double> bends;
  for (std::size_t k = 0; k < problem.contacts.size(); ++k) {
    if (!problem.is_support(k)) continue;
    const double rate = problem.contacts[k].normal.dot(d);
    const double a = rate == 0.0 ? 0.0 : -problem.gap(k, u) / rate;
    if (a > 0.0 && std::isfinite(a)) bends.push_back(a);
  }
  std::sort(bends.begin(), bends.end());
  bends.push_back(std::max(1.0, bends.empty() ? 0.0 : 2.0 * bends.back()));
  double left = 0.0, left_slope = slope(problem, k0, u, d);
  for (std::size_t i = 0; i < bends.size(); ++i) {
    const double right_slope = slope(problem, k0, u + bends[i] * d, d);
    const bool last = i + 1 == bends.size();
    if (right_slope >= 0.0 || last) {
      const double bend = right_slope - left_slope;
      return bend > 0.0 ? left - left_slope * (bends[i] - left) / bend : bends[i];
    }
    left = bends[i];
    left_slope = right_slope;
  }
  return 1.0;
}

/// A zero row has no contact, whose spring would be in it: any stiffness is suitable there.
SparseMatrix weak_support(const SparseMatrix& k) {
  const Vector d = k.diagonal().cwiseAbs();
  SparseMatrix weak(k.rows(), k.cols());
  weak.reserve(Eigen::VectorXi::Constant(k.cols(), 1));
  for (int i = 0; i < d.size(); ++i) weak.insert(i, i) = no_stiffness * (d[i] > 0.0 ? d[i] : 1.0);
  return weak;
}

}  // namespace

std::vector<bool> closed_supports(const StaticProblem& problem) {
  std::vector<bool> closed(problem.contacts.size(), false);
  for (std::size_t k = 0; k < closed.size(); ++k) closed[k] = problem.is_support(k);
  const SparseMatrix weak = weak_support(problem.matrix(closed));
  const SparseMatrix k0 = problem.stiffness + weak;
  Vector u = Vector::Zero(problem.size());
  const std::size_t rounds = 100 + 10 * closed.size();
  for (std::size_t round = 0; round < rounds; ++round) {
    const Vector target = SymmetricSolver(problem.matrix(closed) + weak).solve(problem.right_side(closed));
    const std::vector<bool> next = closed_at(problem, target);
    if (next == closed) return closed;
    if (round == 0) {  // the start is the bilateral equilibrium
      u = target;
    } else {
      const Vector d = target - u;
      u += best_step(problem, k0, u, d) * d;
    }
    const std::vector<bool> reached = closed_at(problem, u);
    if (reached == closed) return closed;  // no descent left: contacts that barely touch
    closed = reached;
  }
  return closed;  // contacts at their limit, within rounding: the caller tries both states
}

}  // namespace signorini
