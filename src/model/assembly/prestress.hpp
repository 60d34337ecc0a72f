// prestress.hpp: geometric stiffness of static forces in the structure (P-delta, run.geometric).
//
//   u^T K_g u = sum over elements of int N v'^2 (line_elements.hpp) + sum over rigid bodies of rz^2 sum F . r
//
// A point of a body at r from its centre moves by rz x r - rz^2 r/2, so forces with a constant direction have
// the potential rz^2/2 sum F . r. This sum does not depend on the centre, because the forces F are in equilibrium. A
// moment M does the work M rz only and contributes nothing. N and F are the forces under the static loads;
// they are kept constant (frozen).
#pragma once

#include <vector>

#include "model/assembly/dofs.hpp"

namespace signorini::assembly {

struct GeometricStiffness {
  SparseMatrix matrix;         ///< n x n
  std::vector<Vector> moving;  ///< columns for unit motions of supports, one for each of DofMap::supports
};

/// K_g of the prestress stored in the map; zero without prestress.
[[nodiscard]] GeometricStiffness assemble_geometric_stiffness(const Scene& scene, const DofMap& map);

/// Static state: displacements, contact forces, and for each of Model::loads whether it acts.
struct StaticForces {
  const Vector& u;
  std::vector<double> N, T;
  std::vector<bool> acts;
};

/// Axial forces of elements and geometric stiffnesses of rigid bodies in a static state. Errors: SceneError if several
/// supports of a rigid body share a force, so that the geometric stiffness of the body is undetermined.
[[nodiscard]] Prestress prestress(const Scene& scene, const DofMap& map, const Model& model,
                                  const StaticForces& standing);

/// Stores the prestress in the map. Errors: SceneError if it belongs to another structure.
void set_prestress(const Prestress& forces, const Scene& scene, DofMap& map);

}  // namespace signorini::assembly
