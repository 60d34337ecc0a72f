// seam_ties.hpp: nodes of tied seams, which follow nodes of their master.
//
//   u_k = sum_l w_kl u_l     along x and y,     w_kl = M_kl / D_k (mesh/mortar.hpp)
//
// Dual mortar: forces on the slave are transferred to the master by T^T f, so a constant stress passes a straight seam
// exactly. If the master itself is tied (rigid body, moving support), the slave follows the same motion.
#pragma once

#include "model/assembly/dofs.hpp"

namespace signorini {

/// Marks the motions of tied nodes as absent, before other motions are numbered. Errors: SceneError for nodes that are
/// moved by supports, rigid bodies or other seams.
void leave_to_master(const Scene& scene, DofMap& map);

/// Numbers the tied motions, after all degrees of freedom and rigid bodies.
void tie_seams(const Scene& scene, DofMap& map);

}  // namespace signorini
