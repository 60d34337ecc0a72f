// rigid_contacts.hpp: requirements of rigid contacts on the structure.
//
//   mass at the contact; a contact without mass has springs (compliance_split.hpp) and is not checked here
//   g(u0) >= 0: no initial penetration
//   contacts that may close together are independent: sum_i c_i n_i = 0 with sum_i c_i g0_i = 0 only if all c_i = 0;
//   otherwise they share one motion, and their individual forces are undetermined
#pragma once

#include "signorini/model.hpp"

namespace signorini::model {

/// Checks the requirements at the top of this file, and sets gaps at u0 to exactly zero if they are zero up to rounding.
/// Errors: SceneError at the place of the contact; the message proposes law = "compliant".
void check_rigid_contacts(const Scene& scene, Model& model);

// Contact elements with a tangential dashpot, as parts of the structure.
//
//   body --+--[ kt ]--+-- p --| friction: stick p' = 0, slip T = -s f N
//          +--[ ct ]--+
//
// The sliding point p becomes a degree of freedom without mass, the element is added to K and C, and the contact acts
// on p. Friction limits the total force of spring and dashpot, so energy is conserved when N or T jump; the element of
// an open contact relaxes with its own time constant ct/kt. At the start p is ut - T/kt, or in a continued run the
// value at the end of the previous run. Friction that rises with the slip rate needs the point p even with ct = 0: the
// rate p' follows from T, and p is its integral.

/// Adds the elements of contacts with tangential_damping > 0, or with a tangential spring and rising
/// friction. The rest of the model must be complete.
void add_shear_elements(const Scene& scene, Model& model);

}  // namespace signorini::model
