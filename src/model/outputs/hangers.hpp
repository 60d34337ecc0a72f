// hangers.hpp: forces of springs with a preload, in the undeformed structure and at the start.
//
//   cold  F_c = preload        at the start  F = preload + k d.u0        variability |F_c - F| / |F|
#pragma once

#include "model/assembly/dofs.hpp"

namespace signorini {

/// Sets Model::hangers; u0 has the physical degrees of freedom.
void find_hangers(const Scene& scene, const DofMap& map, Model& model);

/// |F_c - F| / |F|; infinite if F is zero.
[[nodiscard]] double variability(const HangerLoad& hanger);

/// Warnings for springs whose force in static equilibrium differs much from the preload, or has the opposite sign; one
/// sentence each.
[[nodiscard]] std::vector<std::string> hanger_doubts(const Scene& scene, const Model& model);

}  // namespace signorini
