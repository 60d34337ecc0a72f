#include "model/modes/growth.hpp"

#include <cmath>
#include <limits>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "model/assembly/parts.hpp"
#include "model/assembly/springs.hpp"
#include "model/statics/null_motions.hpp"

namespace signorini {

bool has_negative_energy(const SparseMatrix& k, const Vector& motion) {
  return motion.dot(k * motion) < -rounding::of_many * term_size(k, motion);
}

namespace {

constexpr double no_inertia = 1e-14;  // relative to the terms of x.Mx: rounding
constexpr double no_faster = 1e-9;    // relative change of a rate; its motion then has half as many digits

std::optional<Growth> growth_of_whole(const SparseMatrix& k, const SparseMatrix& mass) {
  Eigen::MatrixXd null = null_motions(k);  // includes motions of negative energy
  if (null.cols() == 0) return std::nullopt;
  for (Eigen::Index j = 0; j < null.cols(); ++j) null.col(j).normalize();
  Growth growth;
  growth.motion = null * symmetric_eigen(null.transpose() * (k * null)).vectors.col(0);
  if (!has_negative_energy(k, growth.motion)) return std::nullopt;

  // Inverse iteration on K + s M with s above the largest sigma^2 found so far. Every Rayleigh quotient is a rate that
  // some motion reaches, so an early end can only underestimate the rate.
  Vector x = growth.motion;
  for (int round = 0; round < 100; ++round) {
    const double energy = x.dot(k * x), inertia = x.dot(mass * x);
    if (!(inertia > no_inertia * term_size(mass, x)) || !std::isfinite(energy / inertia)) {
      growth.rate = std::numeric_limits<double>::infinity();
      return growth;
    }
    const double rate = std::sqrt(std::max(-energy / inertia, 0.0));
    const bool settled = rate <= (1.0 + no_faster) * growth.rate;
    if (rate > growth.rate) growth = {rate, x};
    if (settled) break;
    const SymmetricSolver solver(SparseMatrix(k + 1.5 * growth.rate * growth.rate * mass));
    if (!solver.ok()) break;
    x = solver.solve(mass * x).normalized();
  }
  return growth;
}

}  // namespace

std::optional<Growth> fastest_growth(const SparseMatrix& k, const SparseMatrix& mass) {
  const Parts parts({&k, &mass});
  if (parts.count() == 1) return growth_of_whole(k, mass);
  std::optional<Growth> fastest;
  for (const Part& part : parts) {
    const std::optional<Growth> own = growth_of_whole(part.matrix(k), part.matrix(mass));
    if (!own || (fastest && own->rate <= fastest->rate)) continue;
    fastest = Growth{own->rate, Vector::Zero(k.rows())};
    fastest->motion(part.dofs()) = own->motion;
  }
  return fastest;
}

}  // namespace signorini
