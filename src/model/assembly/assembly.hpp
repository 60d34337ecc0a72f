// assembly.hpp: mass, stiffness and damper matrices of a structure, and its weight.
//
//   M = sum_e M_e + masses,  K = sum_e K_e + springs,  C: dampers,  P_g = M r g,  P_base = -M r a(t)
//   moving supports s(t):  P = -K_fs s - C_fs s' - M_fs s''
//
// r: unit translation of all nodes, fixed degrees of freedom included, so that the weight of a beam next to a
// support is complete. Shapes: n x n, symmetric, both triangles stored.
#pragma once

#include "model/assembly/dofs.hpp"
#include "signorini/model.hpp"

namespace signorini::assembly {

/// Forces on the free degrees of freedom by a unit motion of one support: the support's columns of M_fs, of the
/// dampers, and of K_fs.
struct SupportColumns {
  Vector mass, dampers, stiffness;
};

struct Assembly {
  SparseMatrix mass, dampers, stiffness;
  Vector weight;  ///< P_g: forces, and moments on rotations
  /// M r for each base motion; r: unit translation of all nodes along the base motion, fixed degrees of freedom included.
  std::vector<Vector> base = {};
  std::vector<SupportColumns> moving = {};  ///< one for each of DofMap::supports
};

/// Matrices of a scene with nodes.
[[nodiscard]] Assembly assemble_nodes(const Scene& scene, const DofMap& map);

/// Stiffness of the restoring springs of pendulums alone (Spring::restoring), and its columns of moving supports. The other
/// matrices are zero.
[[nodiscard]] Assembly assemble_restoring_springs(const Scene& scene, const DofMap& map);

/// Matrices from files. Errors: SceneError for wrong sizes, or if M or K is not symmetric.
[[nodiscard]] Assembly assemble_matrices(const Scene& scene, const DofMap& map);

}  // namespace signorini::assembly
