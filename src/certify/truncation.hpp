// truncation.hpp: possible effect of the modes left out on contacts of a reduced model, and on their forces.
//
//   f_d = compliance left out in direction d of a contact  x  the contact's largest force along d
//   off = ringing + the larger f of the contact's two directions
//   displacement = largest off
//   force = largest of off x the contact's spring along d, or off / compliance in d without a spring
//
// ringing: oscillation of the modes left out after jumps of loads. A displacement error across a contact also moves it
// along its tangent, as the deflection of a bent axis does: hence the larger of the two. A spring immediately converts
// an error of the gap to a force; the structure behind it yields later (measured: compared with the full pipeline,
// errors of forces are kn times those of displacements). These are estimates: a change of force may shift an event,
// which they do not include.
#pragma once

#include "signorini/certify.hpp"
#include "signorini/model.hpp"

namespace signorini {

[[nodiscard]] Truncation truncation_of(const Model& model, const Reduction& reduction,
                                       const std::vector<Peak>& peaks);

}  // namespace signorini
