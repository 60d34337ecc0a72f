// rigid_contacts.hpp: requirements of rigid contacts on the structure.
//
//   mass at the contact; otherwise it uses borrowed springs (model/borrowed_springs.hpp) and is not checked here
//   g(u0) >= 0: no initial penetration
//   no c, not zero, with sum_i c_i n_i = 0 and sum_i c_i g0_i = 0 over contacts that may close together: such
//   contacts share one motion, and their individual forces are undetermined
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// Errors: SceneError at the contact's place; it proposes law = "compliant". Gaps at u0 that are zero up to rounding
/// become zero.
void check_rigid_contacts(const Scene& scene, Model& model);

}  // namespace signorini
