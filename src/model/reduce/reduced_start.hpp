// reduced_start.hpp: a static start of a reduced model, in equilibrium to the rounding of the model's own numbers.
//
//   r = P - K q - sum ( n N + t T ),   N = kn g of springs, of rigid ones that of the start, T: initial_shear
//   (K + sum kn n n^T + sum_stuck kt t t^T) d = r,   n . d = 0 of rigid ones
//   q <- q + d,   T <- T + kt t . d where it sticks,   T <- T f|N|/(f|N| before) at its limit
//
// Amplitudes x^T K u0 are known to the roundings of |x|^T |K| |u0| only: of a long pipe to 1e-11 of a support's force. A
// run would begin with that much unbalanced, and contacts at the limit of their friction would slip by it.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// The model is reduced, its matrices are diagonal but for damping. It stays as it is where its start is not static, where
/// contacts that stick rigidly have a part in it, where nothing holds a motion, or where r is no rounding: other loads act.
void settle_start(Model& model);

}  // namespace signorini
