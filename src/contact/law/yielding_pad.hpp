// yielding_pad.hpp: a spring that yields (law = "yielding" in scene files), defined as a user law.
//
//   off       N = 0            while g - p > 0
//   elastic   N = kn (g - p)   while -Y < N < 0
//   crushed   N = -Y           while g' < 0;   then p <- g + Y / kn, and N is continuous
//   T = 0 in all states
//
// p <= 0 is the dent, a length, 0 at the start. kn: force/length, Y: force, both > 0. When the contact has opened again,
// the dissipated work is Y times the increase of |p|.
#pragma once

#include "contact/law/data_laws.hpp"

namespace signorini {

[[nodiscard]] UserContactLaw yielding_pad(double normal_stiffness, double yield_force);

/// The law that scenes name "yielding", with its constant yield_force.
[[nodiscard]] const DataLaw& yielding_law();

}  // namespace signorini
