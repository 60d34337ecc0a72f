// machine_units.hpp: in which units of force, length and time the machine computes a scene.
//
//   length = 2^i ~ extent of the structure       (else a gap, an initial displacement, a static answer)
//   time   = 2^j ~ sqrt(mass / stiffness)        greatest of both (no stiffness: a quarter of the run)
//   force  = 2^k ~ mass length / time^2
//
// Powers of two of the scene's units, found by exponents alone: so they follow a change of units by powers of
// two, the numbers in them stay the same to the last bit, and with them all results. [matrices]: length = 1.
// Beyond 2^120 or below 2^-120 of the scene's the scene's are kept.
#pragma once

#include "signorini/scene.hpp"

namespace signorini {

/// One machine unit of each kind in the scene's units.
[[nodiscard]] Factors machine_units(const Scene& scene);

}  // namespace signorini
