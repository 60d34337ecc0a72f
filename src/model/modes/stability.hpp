// stability.hpp: buckling load factors, at which the geometric stiffness cancels the elastic stiffness.
//
//   (K + lambda K_g) x = 0,   T^T x = 0,   lambda > 0
//   -K_g x = nu (K + s K_g) x,   lambda = s + 1/nu        for any s at which K + s K_g is positive definite
//
// K is positive semidefinite. s = 1 is the structure under the given forces, s = 0 the structure without them; if
// neither is definite (a motion stabilised by the forces only, and forces that are too large), a small s is used.
// Common null motions of both matrices are excluded. Dense up to 200 degrees of freedom; above, part by part
// (parts.hpp), with Lanczos iteration in the norm of K + s K_g for large parts.
#pragma once

#include <optional>
#include <vector>

#include "model/modes/modes.hpp"
#include "signorini/model.hpp"

namespace signorini::modes {

/// Returns the `count` lowest load factors lambda, ascending; a single 0 if the structure is unstable under arbitrarily small
/// forces.
[[nodiscard]] std::vector<double> load_factors(const SparseMatrix& elastic, const SparseMatrix& geometric,
                                               const ContactConstraints& holding, int count);

// Growth rate of an unstable structure.
//
//   K x = -sigma^2 M x,   u ~ exp(sigma t)
//
// Only matrices from files and prestress (run.geometric) can make a structure unstable; members, springs and contacts have no
// negative energy.

struct Growth {
  double rate = 0.0;  ///< sigma; infinite if the motion has no mass
  Vector motion;
};

/// True if the strain energy of the motion is negative beyond the rounding of its evaluation.
[[nodiscard]] bool has_negative_energy(const SparseMatrix& k, const Vector& motion);

/// The fastest growing motion; nullopt if no motion has negative energy. Damping is neglected.
[[nodiscard]] std::optional<Growth> fastest_growth(const SparseMatrix& k, const SparseMatrix& mass);

}  // namespace signorini::modes
