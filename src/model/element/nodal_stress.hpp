// nodal_stress.hpp: stresses of a body at its nodes, from the displacements around them.
//
//   sigma(x_k) = sum_j c_j sigma(x_j),   sum_j c_j q(x_j) = q(x_k),   q: 1, x, y; for t6, q8 also x^2, x y, y^2
//   c: least norm; this equals evaluating the least-squares polynomial through the sigma(x_j)
//
// sigma = (sigma_x, sigma_y, tau_xy), tension positive, force/length^2. x_j: points of the elements around node k at which
// the stresses are most accurate (plane_element.hpp). If these points do not determine the polynomial, or if the polynomial
// would be extrapolated, as at a boundary, the elements around a neighbouring node are used: the neighbour with the
// smallest sum |c_j|, which measures how errors at the points grow. For t6, q8 the polynomial then is a cubic, if a neighbour
// has enough points: a parabola, extrapolated by half an element, has three to four times its error. If no neighbour is
// suitable (a strip of one element across), the stress is the area-weighted mean of the (bi)linear functions in the elements
// at the node. Jumps between elements, a measure of the mesh error, are smoothed.
// Source: Zienkiewicz, Zhu, Int. J. Num. Meth. Eng. 33 (1992), 1331, with one patch per node.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "model/element/mesh.hpp"

namespace signorini::element {

/// Factors of ux and uy of one node in the stresses.
struct StressTerm {
  int node = 0;  ///< node of the mesh
  Eigen::Matrix<double, 3, 2> rows;
};

/// Stresses at mesh node `node` of body `body` of Scene::bodies, without thermal stresses.
[[nodiscard]] std::vector<StressTerm> stress_at_node(const Mesh& mesh, const Scene& scene, std::size_t body,
                                                     int node);

/// Stresses at all nodes of a body. Rows 3 k to 3 k + 2 belong to the body's node k, columns 2 l and 2 l + 1 to ux and uy
/// of the body's node l.
[[nodiscard]] Eigen::SparseMatrix<double, Eigen::RowMajor> nodal_stresses(const Mesh& mesh,
                                                                          const Scene& scene,
                                                                          std::size_t body);

/// - D e: stresses by a unit thermal strain without displacements.
[[nodiscard]] Eigen::Vector3d thermal_stress(const BodySpec& body);

/// Equivalent stress of von Mises, sqrt(3/2 s:s), s being the deviator; heat = alpha T is needed only for plane strain,
/// where sigma_z = nu (sigma_x + sigma_y) - E alpha T.
[[nodiscard]] double von_mises_stress(const BodySpec& body, const Eigen::Vector3d& stress, double heat);

}  // namespace signorini::element
