// reduced_start.hpp: static start of a reduced model, in equilibrium to the rounding of the model's own matrices.
//
//   r = P - K q - sum ( n N + t T ),   N = kn g of springs, of rigid ones that of the start, T: initial_shear
//   (K + sum kn n n^T + sum_stuck kt t t^T) d = r,   n . d = 0 of rigid ones
//   q <- q + d,   T <- T + kt t . d where it sticks,   T <- T f|N|/(f|N| before) at its limit
//
// Amplitudes x^T K u0 have errors of the order of rounding of |x|^T |K| |u0|: for a long pipe 1e-11 of a support force.
// Without this correction a run would begin with that imbalance, and contacts at their friction limit would slip.
#pragma once

#include "signorini/model.hpp"

namespace signorini::reduce {

/// The model must be reduced, with diagonal matrices except for damping. It is unchanged if its start is not static, if
/// it includes rigidly sticking contacts, if there is a mechanism, or if r is larger than rounding: other loads act.
void equilibrate_start(Model& model);

}  // namespace signorini::reduce
