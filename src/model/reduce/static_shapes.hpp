// static_shapes.hpp: shapes for the static compliance of the modes left out.
//
//   massive:   Ritz vectors of (K, M) in the span of G_res f_h,   psi^T M psi = 1,  psi^T K psi = omega_h^2
//   massless:  K-orthonormal, in the span of G_res f, K-orthogonal to the massive ones
//
// A direction gets no shape of its own if its residual compliance, beyond that of earlier shapes, is below 1e-12 of its
// compliance in all modes.
#pragma once

#include <vector>

#include "model/reduce/kept_modes.hpp"

namespace signorini {

/// A direction along which a force acts.
struct ActingForce {
  ComplianceShare share;    ///< with its name; its numbers are computed here
  Vector force;             ///< n
  bool needs_mass = false;  ///< the direction needs inertia
};

struct StaticShapes {
  Eigen::MatrixXd massive, massless;    ///< n x h, n x r
  Eigen::VectorXd massive_squares;      ///< omega_h^2, ascending
  std::vector<ComplianceShare> shares;  ///< one per force, in their order
  std::vector<Vector> answers;          ///< G_res f of every force
};

[[nodiscard]] StaticShapes static_shapes(const SparseMatrix& mass, const SparseMatrix& stiffness,
                                         const KeptModes& modes, const std::vector<ActingForce>& forces);

}  // namespace signorini
