// reactions.hpp: reaction of a support at a node of a rigid body.
//
//   G l = F,   F = ( sum fx, sum fy, sum of (r - r_c) x f + m ),   l = (G^T G)^-1 G^T F
//
//   l: reactions of the body's supports;   f, m: inertia and internal forces at the nodes, minus loads
//
// G has a column for each support: (1, 0, -(y - y_c)), (0, 1, x - x_c), (0, 0, 1). The reactions are determined for up
// to three independent supports. Moments are divided by the size of the body.
#pragma once

#include "model/assembly/dofs.hpp"
#include "model/outputs/structure_rows.hpp"

namespace signorini::outputs {

/// The requested reaction: along d (x, y, rotation) at a node of a body.
struct BodyReaction {
  int body = 0, node = 0;
  std::array<double, 3> d{};
  SourcePlace place;
  std::string key;
};

/// Mesh nodes of a body.
[[nodiscard]] std::vector<int> nodes_of_body(const assembly::DofMap& map, int body);

/// Adds the requested reaction to the row. Errors: SceneError if the supports of the body are statically
/// indeterminate.
void add_body_reaction(const Scene& scene, const assembly::DofMap& map, const StructureRows& rows,
                       const BodyReaction& asked, PhysicalRow& row);

// Forces of springs with a preload, in the undeformed structure and at the start.
//
//   cold  F_c = preload        at t = 0  F = preload + k d.u0        variability |F_c - F| / |F|

/// Sets Model::hangers. Model::u0 must still be in the physical degrees of freedom.
void find_hangers(const Scene& scene, const assembly::DofMap& map, Model& model);

/// |F_c - F| / |F|; infinite if F is zero.
[[nodiscard]] double variability(const HangerLoad& hanger);

/// Warnings for springs whose force in static equilibrium differs much from the preload, or has the opposite sign; one
/// sentence each.
[[nodiscard]] std::vector<std::string> hanger_warnings(const Scene& scene, const Model& model);

}  // namespace signorini::outputs
