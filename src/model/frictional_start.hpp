// frictional_start.hpp: initial = "frictional": loads of each stage, and the initial state that results.
//
//   stage i: dP = sum of its loads d f(0);    without stages: all static loads at once
//   u(0) = u, v(0) = 0, anchors such that T(0) is T at the end of the start
//
// model/statics/frictional.hpp increases the loads.
#pragma once

#include "model/assembly/dofs.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// Sets u0, v0, statics and the shears of contacts. Errors: SceneError for stages that name no load, omit a static one
/// or name one twice, and for a start without equilibrium.
void start_with_friction(const Scene& scene, DofMap& map, Model& model);

}  // namespace signorini
