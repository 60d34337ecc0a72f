// nodal_stress.hpp: stresses of a body at its nodes, by the displacements around them.
//
//   sigma(x_k) = sum_j c_j sigma(x_j),   sum_j c_j q(x_j) = q(x_k) for 1, x, y (t3, q4), x^2, x y, y^2 too (t6, q8)
//   c: the shortest of these, which is the polynomial that fits the sigma(x_j) best
//
// sigma = (sigma_x, sigma_y, tau_xy), tension positive, force/length^2. x_j: the points of the elements round node k at which their
// stresses are most accurate (plane_element.hpp). Where they do not determine the polynomial, or where it leads beyond them, as on a
// boundary, the elements round another node of the same elements take their place: of those nodes that one which makes sum |c_j|,
// the growth of errors at the points, least. Where none will do (a strip of one element across) it is the mean over the elements at
// the node, weighted by areas, of the (bi)linear function in each.
// So stresses at boundaries have the order of those inside. Jumps between elements, which measure the mesh, are rounded off.
// Source: Zienkiewicz, Zhu, Int. J. Num. Meth. Eng. 33 (1992), 1331, with one patch a node.
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
