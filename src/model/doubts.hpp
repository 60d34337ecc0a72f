// doubts.hpp: what a scene may say and hardly means. It is computed as it stands, and said.
//
//   load on nothing that can move       direction . u = 0 for all u
//   rotations of nothing               idle_rotations.hpp
//   fall away from all contacts         n . a >= 0 at all of them, a = Z (Z^T M Z)^-1 Z^T P: the free fall
//                                       of a part (Z: its motions without stiffness) under the static loads
//   weight that comes at t = 0          a gap of zero, nothing at rest in equilibrium
//   drag                                alpha M acts on motions without stiffness: v ~ exp(-alpha t)
//   friction above 2                    an angle, a percentage?
//   initial_shear in a static start     which has no friction: nothing carries it
//   initial values without mass         which equilibrium decides (initial_state.hpp)
//   another structure                   in the scene of the run that this one goes on from
//   a pulse too short for the clock     100 eps (t + t_end)
//   a support that jumps at t = 0      or its velocity: the state is the one after
//   flutter after a frictional start    contacts slip at their limits (slip_growth.hpp); what runs away
//                                       there is refused
#pragma once

#include <string>
#include <vector>

#include "model/assembly/dofs.hpp"
#include "signorini/scene.hpp"

namespace signorini {

/// One sentence each. Errors: SceneError, as above. The model: before its reduction and without shear
/// elements, damping and initial state set.
[[nodiscard]] std::vector<std::string> doubts(const Scene& scene, const DofMap& map, const Model& model);

}  // namespace signorini
