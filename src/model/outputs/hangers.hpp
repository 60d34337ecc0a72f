// hangers.hpp: what springs with a preload bear, before anything has moved and at the start.
//
//   cold  F_c = preload        at the start  F = preload + k d.u0        variability |F_c - F| / |F|
#pragma once

#include "model/assembly/dofs.hpp"

namespace signorini {

/// Sets Model::hangers; u0 is of the physical degrees of freedom.
void find_hangers(const Scene& scene, const DofMap& map, Model& model);

/// Infinite where F is zero.
[[nodiscard]] double variability(const HangerLoad& hanger);

/// Springs in static equilibrium that bear much more, or less, or the other way, than before: one sentence each.
[[nodiscard]] std::vector<std::string> hanger_doubts(const Scene& scene, const Model& model);

}  // namespace signorini
