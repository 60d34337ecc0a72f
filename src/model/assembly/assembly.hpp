// assembly.hpp: mass, stiffness and dampers of a structure, and its weight.
//
//   M = sum_e M_e + masses,  K = sum_e K_e + springs,  C = dampers,  P_g = M r g,  P_base = -M r a(t)
//
// r g: the acceleration of gravity on all translations, fixed ones included, so that the weight of a
// beam next to a support arrives complete. Shapes: n x n, symmetric, both triangles stored.
#pragma once

#include "model/assembly/dofs.hpp"
#include "signorini/model.hpp"

namespace signorini {

struct Assembly {
  SparseMatrix mass, dampers, stiffness;
  Vector weight;  ///< P_g: force, moments on rotations
  Vector base;    ///< M r, r: a unit motion of the base, fixed degrees of freedom included; empty without
};

[[nodiscard]] Assembly assemble_nodes(const Scene& scene, const DofMap& map);

/// The matrices of the file. Errors: SceneError for wrong sizes, M or K not symmetric.
[[nodiscard]] Assembly assemble_matrices(const Scene& scene, const DofMap& map);

}  // namespace signorini
