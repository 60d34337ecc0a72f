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
/// definite on the degrees of freedom with mass, or if a massless one has neither stiffness nor damping.
void mark_massless(const Scene& scene, const assembly::DofMap& map, const assembly::Assembly& assembly,
                   std::vector<Dof>& dofs);

/// Errors: SceneError if neither stiffness nor damping nor a contact resists a massless motion, or if a negative
/// stiffness makes such a motion unstable.
void check_massless(const Scene& scene, const Model& model, const assembly::DofMap& map);

// Separates massless motions without damping from damped massless degrees of freedom.
//
//   C_mm z = 0, z_p = 1:    u_i = u'_i + z_i u'_p,   u_p = u'_p          u = B u'
//
// beta K damps the bars of a massless frame, but not its rotation as a rigid body about the point with mass.
// The rotation follows forces immediately, other motions follow with time constants; for the integration each
// needs its own degree of freedom. In terms of u', the row and the column of p in C are zero. K and the forms of
// contacts and loads are transformed (B^T K B, B^T n). M stays the same, because its massless rows are zero.

/// Sets Model::basis if needed. The model must be complete, neither reduced nor with shear elements yet.
void separate_undamped(Model& model);

// Rotations without a connection to any element.
//
//   node of elements without rz (bodies, bars, hinged ends), with rotational springs or inertia:
//   J phi'' + c phi' + k phi = M       separate equation of this node, because no element rotates with it
//   fix = ["rz"] at this node          has no effect; a warning is issued if the support may be meant to clamp
//                                      a body of plane elements

/// Warnings about rotations without a connection to an element, one sentence per table. map: numbering of the same scene.
[[nodiscard]] std::vector<std::string> unconnected_rotations(const Scene& scene, const assembly::DofMap& map);

}  // namespace signorini::model
