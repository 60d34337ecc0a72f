// massless.hpp: degrees of freedom without mass, and what must hold their motion instead.
//
//   M = [M_dd 0; 0 0],   M_dd positive definite,   C_mm u' + K_mm u = ... solvable for u' or u
#pragma once

#include "model/assembly/assembly.hpp"

namespace signorini {

/// Marks massless degrees of freedom (zero rows of M). Errors: SceneError when nothing has mass, when M
/// is not positive definite on the rest, or when a massless degree of freedom has neither stiffness nor
/// damping.
void mark_massless(const Scene& scene, const DofMap& map, const Assembly& assembly, std::vector<Dof>& dofs);

/// Errors: SceneError when a motion without mass is held neither by K nor by C nor by any contact, or is driven away
/// by a negative stiffness.
void check_massless(const Scene& scene, const Model& model, const DofMap& map);

}  // namespace signorini
