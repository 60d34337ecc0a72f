// stiffness_range.hpp: stiffnesses of one scene whose ratio no double can square.
//
//   k_max / k_min <= sqrt(greatest double) = 1.34e154,     k: EA/L of members, EI/L^3, springs, contacts   [force/length]
//
// Frequencies go with sqrt(k), energies and quotients of modes with k^2 / k'^2: beyond that they overflow, or vanish,
// whatever the units. Such a number is a slip of the pen; what it would mean is a rigid body, or no member at all.
#pragma once

#include "model/assembly/dofs.hpp"

namespace signorini {

/// Errors: SceneError at the member, spring or contact whose number has the greater power of ten, up or down.
void check_stiffness_range(const Scene& scene, const DofMap& map);

}  // namespace signorini
