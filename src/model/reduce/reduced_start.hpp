// reduced_start.hpp: static start of a reduced model, in equilibrium up to the rounding of the reduced matrices.
//
//   r = P - K q - sum ( n N + t T ): imbalance,   N = kn g, at rigid contacts N of the start,   T: initial_shear
//   (K + sum kn n n^T + sum_stuck kt t t^T) d = r,   n . d = 0 at rigid contacts
//   q <- q + d,   T <- T + kt t . d in stick,   T <- T f|N|/(f|N| before) at the friction limit
//
// Amplitudes x^T K u0 have errors of the order of rounding of |x|^T |K| |u0|: for a long pipe 1e-11 of a support force.
// Without this correction a run would begin with the imbalance r, and contacts at their friction limit would slip.
#pragma once

#include "signorini/model.hpp"

namespace signorini::reduce {

/// Corrects the start of a reduced model, whose M and K are diagonal. The model is unchanged if its start is
/// not static, if contacts stick rigidly, if there is a mechanism, or if r is larger than rounding
/// because the static start does not include all loads.
void equilibrate_start(Model& model);

}  // namespace signorini::reduce
