// doubts.hpp: model warnings: valid input that probably is a mistake. It is computed as given, with a warning.
//
//   load without effect                 direction . u = 0 for all u
//   idle rotations                     idle_rotations.hpp
//   a part leaves all contacts          n . a >= 0 at all of them, a = Z (Z^T M Z)^-1 Z^T P: the free fall
//                                       of a part (Z: its motions without stiffness) under the static loads
//   weight applied suddenly at t = 0    a gap of zero, no part at rest in equilibrium
//   drag                                alpha M acts on rigid-body motions: v ~ exp(-alpha t)
//   friction above 2                    an angle, a percentage?
//   initial_shear in a static start     a static start has no friction that could carry it
//   initial values without mass         equilibrium determines them (initial_state.hpp)
//   different structure                 in the scene of the run that this one continues
//   a pulse too short for the clock     100 eps (t + t_end)
//   a support that jumps at t = 0      or whose velocity jumps: the initial state is the one after the jump
//   flutter after a frictional start    contacts slip at their limits (slip_growth.hpp); divergence there
//                                       is refused
#pragma once

#include <string>
#include <vector>

#include "model/assembly/dofs.hpp"
#include "signorini/scene.hpp"

namespace signorini {

/// One sentence per warning. Errors: SceneError, as above. The model must be complete (damping and initial state set),
/// but not yet reduced, and without shear elements.
[[nodiscard]] std::vector<std::string> doubts(const Scene& scene, const DofMap& map, const Model& model);

}  // namespace signorini
