// shear.hpp: contact elements with a tangential dashpot, as parts of the structure.
//
//   body --+--[ kt ]--+-- p --| friction: stick p' = 0, slip T = -s f N
//          +--[ ct ]--+
//
// The point p that slides becomes a degree of freedom without mass, the element enters K and C, and the
// contact acts on p. Friction limits the force of spring and dashpot together, so energy is conserved when
// N or T jump; an open contact's element comes to rest with its own time constant ct/kt. At the start p is
// ut - T/kt, or where the run that this one goes on from left it. Friction that rises with the slip rate needs the
// point with ct = 0, too: p' follows from T, and p is what it comes to.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// For contacts with tangential_damping > 0, or a spring and friction that rises; everything else in the model is complete.
void add_shear_elements(const Scene& scene, Model& model);

}  // namespace signorini
