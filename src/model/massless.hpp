// massless.hpp: degrees of freedom without mass, and what must hold their motion instead.
//
//   M = [M_dd 0; 0 0],   M_dd positive definite,   C_mm u' + K_mm u = ... solvable for u' or u
#pragma once

#include "model/assembly/assembly.hpp"

namespace signorini {

/// Marks massless degrees of freedom (zero rows of M). Errors: SceneError when nothing has mass, when M
/// is not positive definite on the rest, or when a massless degree of freedom has neither stiffness nor
/// damping. `place`: where the message points to.
void mark_massless(const Assembly& assembly, std::vector<Dof>& dofs, const SourcePlace& place);

/// Where messages point to: the scene, and where its stiffness is given.
struct MasslessPlaces {
  SourcePlace scene, stiffness;
  std::string stiffness_key;
};

/// Errors: SceneError when a motion without mass is held neither by K nor by C nor by any contact, or is driven away
/// by a negative stiffness.
void check_massless(const Model& model, const DofMap& map, const MasslessPlaces& place);

}  // namespace signorini
