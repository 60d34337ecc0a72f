// buckling.hpp: by how much forces could grow until their geometric stiffness takes the elastic one away.
//
//   (K + lambda K_g) x = 0,   T^T x = 0,   lambda > 0
//   -K_g x = nu (K + s K_g) x,   lambda = s + 1/nu        for any s at which K + s K_g is positive definite
//
// K is positive semidefinite. At s = 1 the forces themselves stand, s = 0 is the structure without them; where neither
// is definite (a motion that only forces hold, and forces that are too great) a small s is. Motions that neither
// matrix resists have no part in it. Dense up to 200 degrees of freedom; above, part by part (parts.hpp), large parts by
// Lanczos iteration in the norm of K + s K_g.
#pragma once

#include <vector>

#include "model/modes/modes.hpp"

namespace signorini {

/// The lowest `count` of all lambda, ascending; 0, alone: under the smallest forces some motion falls.
[[nodiscard]] std::vector<double> load_factors(const SparseMatrix& elastic, const SparseMatrix& geometric,
                                               const Holding& holding, int count);

}  // namespace signorini
