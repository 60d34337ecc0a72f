// frictional_start.hpp: initial = "frictional": which loads grow in which stage, and what the run begins
// with.
//
//   stage i: dP = sum of its loads d f(0);    without stages: all static loads at once
//   u(0) = u, v(0) = 0, anchors such that T(0) is the T that the start ended with
//
// How the loads grow: model/statics/frictional.hpp.
#pragma once

#include "model/assembly/dofs.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// Sets u0, v0, statics and the shears of contacts. Errors: SceneError for stages that name no load, leave
/// out a static one or name one twice, and for a start that is no equilibrium.
void start_with_friction(const Scene& scene, DofMap& map, Model& model);

}  // namespace signorini
