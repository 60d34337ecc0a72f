// truncation.hpp: what leaving modes out may have moved the contacts of a reduced model, and their forces.
//
//   f_d = compliance left out in direction d of a contact  x  the contact's greatest force along d
//   off = ringing + the greater f of the contact's two
//   displacement = greatest off
//   force = greatest of off x the contact's spring along d, or off / compliance in d where it has none
//
// ringing: of the jumps of loads in the modes left out. A motion that is off across a contact moves it along
// its tangent, too, as an axis that is bent does: hence the greater of the two. A spring makes of a gap that
// is off what its stiffness says at once; the structure behind it yields later (measured: beside the full
// pipeline, forces are off by kn times what displacements are). Estimates: a change of force may shift an
// event, which they know nothing of.
#pragma once

#include "signorini/certify.hpp"
#include "signorini/model.hpp"

namespace signorini {

[[nodiscard]] Truncation truncation_of(const Model& model, const Reduction& reduction,
                                       const std::vector<Peak>& peaks);

}  // namespace signorini
