// seam_ties.hpp: nodes of tied seams, which follow those of their master.
//
//   u_k = sum_l w_kl u_l     along x and y,     w_kl = M_kl / D_k (mesh/mortar.hpp)
//
// Dual mortar: what the slave bears goes to the master as T^T f, so a constant stress passes a straight seam exactly. What
// the master follows (a rigid body, a support that moves) the slave follows, too.
#pragma once

#include "model/assembly/dofs.hpp"

namespace signorini {

/// Marks the motions of tied nodes as absent, before others are numbered. Errors: SceneError for nodes that supports, rigid
/// bodies or other seams move.
void leave_to_master(const Scene& scene, DofMap& map);

/// Numbers them, once all degrees of freedom are, and rigid bodies tied.
void tie_seams(const Scene& scene, DofMap& map);

}  // namespace signorini
