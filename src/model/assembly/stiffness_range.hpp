// stiffness_range.hpp: refuses scenes whose stiffness ratio overflows when squared.
//
//   k_max / k_min <= sqrt(greatest double) = 1.34e154,     k: EA/L of members, EI/L^3, springs, contacts   [force/length]
//
// Frequencies scale with sqrt(k), energies and Rayleigh quotients with k^2 / k'^2; beyond this limit they overflow or
// underflow in any units. Such a number is a typing error; a rigid body, or no member at all, would express its
// intention.
#pragma once

#include "model/assembly/dofs.hpp"

namespace signorini {

/// Errors: SceneError at the member, spring or contact whose stiffness has the larger exponent in magnitude.
void check_stiffness_range(const Scene& scene, const DofMap& map);

}  // namespace signorini
