// rigid_contacts.hpp: what rigid contacts need of a structure.
//
//   where they act there is mass; else they borrow springs (model/borrowed_springs.hpp) and are none of these
//   g(u0) >= 0: nothing starts inside
//   no c, not zero, with sum_i c_i n_i = 0 and sum_i c_i g0_i = 0 over contacts that may close together: such
//   contacts share one motion, and nobody can say which of them carries the force
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// Errors: SceneError with the contact's place; it proposes law = "compliant". Gaps of u0 that are zero but
/// for roundoff become zero.
void check_rigid_contacts(const Scene& scene, Model& model);

}  // namespace signorini
