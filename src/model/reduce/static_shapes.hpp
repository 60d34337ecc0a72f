// static_shapes.hpp: shapes that carry the static compliance of the modes left out.
//
//   massive:   Ritz vectors of (K, M) in the span of G_res f_h,   psi^T M psi = 1,  psi^T K psi = omega_h^2
//   massless:  K-orthonormal, in the span of G_res f, K-orthogonal to the massive ones
//
// A direction whose residual compliance, less what earlier shapes have of it, is below 1e-12 of its
// compliance in all modes needs no shape of its own.
#pragma once

#include <vector>

#include "model/reduce/kept_modes.hpp"

namespace signorini {

/// A force along which something acts.
struct ActingForce {
  ComplianceShare share;    ///< named; its numbers are found here
  Vector force;             ///< n
  bool needs_mass = false;  ///< what acts there needs inertia
};

struct StaticShapes {
  Eigen::MatrixXd massive, massless;    ///< n x h, n x r
  Eigen::VectorXd massive_squares;      ///< omega_h^2, ascending
  std::vector<ComplianceShare> shares;  ///< of all forces, in their order
  std::vector<Vector> answers;          ///< G_res f of every force
};

[[nodiscard]] StaticShapes static_shapes(const SparseMatrix& mass, const SparseMatrix& stiffness,
                                         const KeptModes& modes, const std::vector<ActingForce>& forces);

}  // namespace signorini
