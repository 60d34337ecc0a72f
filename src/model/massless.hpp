// massless.hpp: degrees of freedom without mass, and the check that stiffness or damping constrains them.
//
//   M = [M_dd 0; 0 0],   M_dd positive definite,   C_mm u' + K_mm u = ... solvable for u' or u
#pragma once

#include "model/assembly/assembly.hpp"

namespace signorini {

/// Marks massless degrees of freedom (zero rows of M). Errors: SceneError if nothing has mass, if M is not positive
/// definite on the rest, or if a massless degree of freedom has neither stiffness nor damping.
void mark_massless(const Scene& scene, const DofMap& map, const Assembly& assembly, std::vector<Dof>& dofs);

/// Errors: SceneError if a motion without mass is resisted neither by K nor by C nor by any contact, or if it is
/// unstable by a negative stiffness.
void check_massless(const Scene& scene, const Model& model, const DofMap& map);

}  // namespace signorini
