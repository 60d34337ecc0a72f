// buckling.hpp: buckling load factors, at which the geometric stiffness cancels the elastic stiffness.
//
//   (K + lambda K_g) x = 0,   T^T x = 0,   lambda > 0
//   -K_g x = nu (K + s K_g) x,   lambda = s + 1/nu        for any s at which K + s K_g is positive definite
//
// K is positive semidefinite. s = 1 is the structure under the given forces, s = 0 the structure without them; if
// neither is definite (a motion stabilised by the forces only, and forces that are too large), a small s is used.
// Common null motions of both matrices are excluded. Dense up to 200 degrees of freedom; above, part by part
// (parts.hpp), with Lanczos iteration in the norm of K + s K_g for large parts.
#pragma once

#include <vector>

#include "model/modes/modes.hpp"

namespace signorini {

/// The lowest `count` of all lambda, ascending; a single 0: unstable under arbitrarily small forces.
[[nodiscard]] std::vector<double> load_factors(const SparseMatrix& elastic, const SparseMatrix& geometric,
                                               const Holding& holding, int count);

}  // namespace signorini
