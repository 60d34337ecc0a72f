// massless.hpp: degrees of freedom without mass, and the check that stiffness or damping constrains them.
//
//   M = [M_dd 0; 0 0],   M_dd positive definite,   C_mm u' + K_mm u = ... solvable for u' or u
#pragma once

#include <string>
#include <vector>

#include "model/assembly/assembly.hpp"
#include "model/assembly/dofs.hpp"
#include "signorini/model.hpp"
#include "signorini/scene.hpp"

namespace signorini::model {

/// Marks massless degrees of freedom (zero rows of M). Errors: SceneError if nothing has mass, if M is not positive
/// definite on the rest, or if a massless degree of freedom has neither stiffness nor damping.
void mark_massless(const Scene& scene, const assembly::DofMap& map, const assembly::Assembly& assembly,
                   std::vector<Dof>& dofs);

/// Errors: SceneError if a motion without mass is resisted neither by K nor by C nor by any contact, or if it is
/// unstable by a negative stiffness.
void check_massless(const Scene& scene, const Model& model, const assembly::DofMap& map);

// Separates massless motions without damping from damped massless degrees of freedom.
//
//   C_mm z = 0, z_p = 1:    u_i = u'_i + z_i u'_p,   u_p = u'_p          u = B u'
//
// beta K damps the bars of a massless frame, but not its rotation as a rigid body about the point with mass.
// The rotation follows forces immediately, other motions follow with time constants; for integration each
// needs its own degree of freedom. With u' the row and the column of p in C are zero. K and the forms of
// contacts and loads are transformed (B^T K B, B^T n); M is zero there.

/// Sets Model::basis if needed. The model must be complete, neither reduced nor with shear elements yet.
void separate_undamped(Model& model);

// Rotations without a connection to any element.
//
//   node of elements without rz (bodies, bars, hinged ends), with springs of rotations or inertia:
//   J phi'' + c phi' + k phi = M       of that node alone; no element is connected to it
//   fix = ["rz"] there                 has no effect; reported if it could be meant to clamp a body of plane
//                                      elements

/// Warnings about them, one sentence per table of the scene. map: of this scene.
[[nodiscard]] std::vector<std::string> unconnected_rotations(const Scene& scene, const assembly::DofMap& map);

}  // namespace signorini::model
