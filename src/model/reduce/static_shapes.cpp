#include "model/reduce/static_shapes.hpp"

#include <cmath>

#include "base/eigen_dense.hpp"

namespace signorini {
namespace {

constexpr double needless = 1e-12;  // relative to a direction's compliance: a smaller part needs no shape
constexpr double no_mass = 1e-12;   // 1/omega^2 of a Ritz vector relative to the largest one

/// sum over the kept modes with stiffness: (phi^T f)^2/omega^2.
double compliance_of_kept(const KeptModes& modes, const Vector& f) {
  const Vector part = parts(modes, f);
  double sum = 0.0;
  for (Eigen::Index j = modes.free; j < part.size(); ++j) sum += part[j] * part[j] / modes.squares[j];
  return sum;
}

/// Subtracts from x its part along the K-orthonormal columns of the basis, twice because of rounding.
Vector rest_of(const Vector& x, const Eigen::MatrixXd& basis, const SparseMatrix& k) {
  Vector rest = x;
  for (int round = 0; round < 2 && basis.cols() > 0; ++round)
    rest -= basis * (basis.transpose() * (k * rest));
  return rest;
}

}  // namespace

StaticShapes static_shapes(const SparseMatrix& mass, const SparseMatrix& stiffness, const KeptModes& modes,
                           const std::vector<ActingForce>& forces) {
  const auto n = mass.rows();
  StaticShapes result;
  const ResidualFlexibility flexibility(mass, stiffness, modes);
  Eigen::MatrixXd basis(n, 0);  // K-orthonormal
  const auto extend = [&](bool needs_mass) {
    for (std::size_t i = 0; i < forces.size(); ++i) {
      if (forces[i].needs_mass != needs_mass) continue;
      const Vector rest = rest_of(result.answers[i], basis, stiffness);
      const double energy = rest.dot(stiffness * rest);
      const double all = compliance_of_kept(modes, forces[i].force) + forces[i].force.dot(result.answers[i]);
      if (!(energy > needless * all)) continue;
      basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
      basis.rightCols(1) = rest / std::sqrt(energy);
    }
  };
  for (const ActingForce& f : forces) {
    result.answers.push_back(flexibility.answer(f.force));
    const double residual = std::max(0.0, f.force.dot(result.answers.back()));
    result.shares.push_back(f.share);
    result.shares.back().compliance = compliance_of_kept(modes, f.force) + residual;
    result.shares.back().residual = residual;
  }
  extend(true);
  const Eigen::Index massive = basis.cols();
  extend(false);
  result.massless = basis.rightCols(basis.cols() - massive);
  if (massive == 0) {
    result.massive.resize(n, 0);
    return result;
  }
  // K = 1 in the basis: 1/omega^2 are the eigenvalues of its mass; the largest belongs to the lowest frequency.
  const Eigen::MatrixXd h = basis.leftCols(massive);
  const EigenPairs ritz = symmetric_eigen(h.transpose() * (mass * h));
  result.massive.resize(n, massive);
  result.massive_squares.resize(massive);
  Eigen::Index count = 0;
  for (Eigen::Index j = massive - 1; j >= 0; --j) {
    if (!(ritz.values[j] > no_mass * ritz.values[massive - 1])) break;
    result.massive.col(count) = h * ritz.vectors.col(j) / std::sqrt(ritz.values[j]);
    result.massive_squares[count++] = 1.0 / ritz.values[j];
  }
  result.massive.conservativeResize(Eigen::NoChange, count);
  result.massive_squares.conservativeResize(count);
  return result;
}

}  // namespace signorini
