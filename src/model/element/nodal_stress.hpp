// nodal_stress.hpp: stresses of a body at its nodes, by the displacements around them.
//
//   sigma(x_k) = sum_e A_e sigma_e(x_k) / sum_e A_e,   sigma_e(x) = D ( sum_p L_p(x) B(x_p) u - alpha T e )
//
// sigma = (sigma_x, sigma_y, tau_xy), tension positive, force/length^2. e: elements at node k, A_e: their areas, x_p: points where
// their stresses are most accurate, L_p: the (bi)linear function of point p (plane_element.hpp).
// The mean is exact where stresses are constant, and continuous; it rounds off jumps between elements, which measure the mesh.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "model/element/mesh.hpp"

namespace signorini {

/// Factors of the displacements of a node.
struct StressTerm {
  int node = 0;  ///< of the mesh
  Eigen::Matrix<double, 3, 2> rows;
};

/// Stresses at a node of a body, an index into Scene::bodies, but for those of heat.
[[nodiscard]] std::vector<StressTerm> stress_at_node(const Mesh& mesh, const Scene& scene, std::size_t body,
                                                     int node);

/// Stresses at all nodes of a body: rows 3 k to 3 k + 2 at its node k, columns 2 l and 2 l + 1 by ux and uy of its node l.
[[nodiscard]] Eigen::SparseMatrix<double, Eigen::RowMajor> nodal_stresses(const Mesh& mesh,
                                                                          const Scene& scene,
                                                                          std::size_t body);

/// - D e: stresses by a thermal strain of one where nothing moves.
[[nodiscard]] Eigen::Vector3d stress_of_heat(const BodySpec& body);

/// Equivalent stress of von Mises, sqrt(3/2 s:s), s the deviator; heat: alpha T, counts in plane strain alone, where
/// sigma_z = nu (sigma_x + sigma_y) - E alpha T.
[[nodiscard]] double mises(const BodySpec& body, const Eigen::Vector3d& stress, double heat);

}  // namespace signorini
