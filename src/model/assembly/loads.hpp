// loads.hpp: loads as forms on the structure's degrees of freedom, times functions of time.
//
//   P(t) = sum_i d_i f_i(t)
//
//   force, moment    on the node's own degrees of freedom
//   distributed      q on an element of length L, in the element's axes:  q_x L/2, q_y L/2, +- q_y L^2/12 at its ends
//   traction q on an edge of a body  t int N q ds;  pressure p: q = -p nu, nu outward
//   preload F of a spring            -F d at its node, F d at the other end
//   temperature T, initial strain    EA alpha T (-e, e), EA strain (-e, e), e along the element
//   weight, base     M r g, -M r a(t)
//   support s(t)     -K_fs s;   velocity and acceleration: -C_fs s' - M_fs s'',   C = D + alpha M + beta K
#pragma once

#include <array>
#include <vector>

#include "model/assembly/assembly.hpp"
#include "signorini/model.hpp"

namespace signorini::assembly {

/// Name of the velocity of a support's motion: "support A.ux" -> "support A.vx".
[[nodiscard]] std::string rate_of(const std::string& support_motion);
/// Name of a load: its given name, otherwise "load 1", "load 2", ... number: position in [[loads]], from 1.
[[nodiscard]] std::string name_of(const LoadSpec& load, std::size_t number);
/// Name of a member's strain load: temperature or initial strain.
[[nodiscard]] std::string name_of_strain(LoadKind kind, int member);
/// Force on a mesh node for a unit amplitude of the load.
struct NodeForce {
  int node = 0;
  std::array<double, 2> force{0.0, 0.0};
};
/// Nodal forces of a traction or pressure with unit amplitude.
[[nodiscard]] std::vector<NodeForce> traction_forces(const Scene& scene, const element::Mesh& mesh,
                                                     const LoadSpec& spec);
/// Name of the preload of a spring. spring: index into Scene::springs.
[[nodiscard]] std::string name_of_preload(std::size_t spring);
/// Load::history_unit of loads of this type.
[[nodiscard]] Unit unit_of_history(LoadType type);
/// All loads of the scene: gravity first (if it acts), then the loads in the order of the file, strains of
/// members, base motion, and displacements of moving supports. Errors: SceneError.
[[nodiscard]] std::vector<Load> make_loads(const Scene& scene, const DofMap& map, const Assembly& assembly);

/// Prescribed motion of support i of DofMap::supports; a continued run begins at the support's last position.
[[nodiscard]] History motion_of_support(const Scene& scene, const DofMap& map, int i);
/// Prescribed motion of a moving support of Scene::supports.
[[nodiscard]] History motion_of_support(const Scene& scene, const Support& support);

/// Appends the loads that velocities and accelerations of supports cause; to be called when the damping is known.
/// Errors: SceneError for a motion with a jump or a kink if dampers or masses would respond with an impulse.
void add_support_rates(const Scene& scene, const DofMap& map, const Assembly& assembly, double alpha,
                       double beta, std::vector<Load>& loads);

/// Adds the geometric stiffness to the support loads -K_fs s. columns: its columns, one for each of DofMap::supports.
void add_geometric_supports(const Scene& scene, const DofMap& map, const std::vector<Vector>& columns,
                            std::vector<Load>& loads);

/// Sum of the static loads; length n.
[[nodiscard]] Vector static_load(const std::vector<Load>& loads, int n);

}  // namespace signorini::assembly
