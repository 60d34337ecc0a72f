// geometric.hpp: the stiffness of forces that stand in the structure (P-delta, run.geometric).
//
//   K_g = sum over elements of the integral of N v'^2   (beam.hpp, bar.hpp)   +   rz^2 sum F . r of each rigid body
//
// A point of a body at r from its centre moves by rz x r - rz^2 r/2. So forces that keep their direction have the
// potential rz^2/2 sum F . r; it does not depend on the centre, since the F are in equilibrium. A moment works by
// M rz alone and has no part in it. N and F are those of the static loads, and frozen.
#pragma once

#include <vector>

#include "model/assembly/dofs.hpp"

namespace signorini {

struct GeometricStiffness {
  SparseMatrix matrix;         ///< n x n
  std::vector<Vector> moving;  ///< what a unit motion of a support does, one for each of DofMap::supports
};

/// Of the forces that the map has; zero where it has none.
[[nodiscard]] GeometricStiffness assemble_geometric(const Scene& scene, const DofMap& map);

/// What stands in the structure: displacements, forces of contacts, loads that act, one of Model::loads each.
struct StandingForces {
  const Vector& u;
  std::vector<double> N, T;
  std::vector<bool> acts;
};

/// Errors: SceneError for a rigid body whose supports share a force that decides over its stiffness.
[[nodiscard]] FrozenForces frozen_forces(const Scene& scene, const DofMap& map, const Model& model,
                                         const StandingForces& standing);

/// Puts them into the map. Errors: SceneError where they are those of another structure.
void freeze(const FrozenForces& forces, const Scene& scene, DofMap& map);

}  // namespace signorini
