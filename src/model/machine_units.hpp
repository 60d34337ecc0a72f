// machine_units.hpp: units of force, length and time for internal computation.
//
//   length = 2^i ~ extent of the structure       (otherwise a gap, an initial displacement, a static response)
//   time   = 2^j ~ sqrt(mass / stiffness)        largest of each (no stiffness: a quarter of the run)
//   force  = 2^k ~ mass length / time^2
//
// These are powers of two times the scene's units, found from exponents alone. They follow a change of units by powers
// of two, so all numbers and all results stay bitwise the same. [matrices]: length = 1. Beyond 2^120 or below 2^-120 of
// the scene's units, the scene's units are used.
#pragma once

#include "signorini/scene.hpp"

namespace signorini {

/// One internal unit of each kind, in the scene's units.
[[nodiscard]] Factors machine_units(const Scene& scene);

}  // namespace signorini
