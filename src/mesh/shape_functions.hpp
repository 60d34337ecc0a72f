// shape_functions.hpp: shape functions of triangles and quadrilaterals, and integration points.
//
//   x(a, b) = sum_k N_k(a, b) x_k;   triangles: 0 <= a, b, a + b <= 1;   quadrilaterals: -1 <= a, b <= 1
//
// Edges: -1 <= s <= 1, N = (1 -+ s)/2, or s(s -+ 1)/2 at the ends and 1 - s^2 in the middle.
// Node numbering: signorini/plane_mesh.hpp.
// Source: Zienkiewicz, Taylor, The Finite Element Method (2000), chapters 8 and 9; six-point rule: Strang and Fix
// (1973).
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "signorini/plane_mesh.hpp"

namespace signorini::mesh {

[[nodiscard]] std::size_t node_count(PlaneShape shape);
[[nodiscard]] constexpr std::size_t corner_count(PlaneShape shape) {
  return shape == PlaneShape::t3 || shape == PlaneShape::t6 ? 3 : 4;
}
[[nodiscard]] constexpr bool has_midside_nodes(PlaneShape shape) {
  return shape == PlaneShape::t6 || shape == PlaneShape::q8;
}

/// Values of the shape functions, and their derivatives with respect to a and b; one row per node.
struct ShapeValues {
  Eigen::VectorXd values;
  Eigen::MatrixX2d gradients;
};
[[nodiscard]] ShapeValues shape_functions(PlaneShape shape, double a, double b);

struct IntegrationPoint {
  double a = 0.0, b = 0.0, weight = 0.0;
};
/// Gauss rule that integrates the mass of elements with straight edges exactly: 3 points (t3), 6 (t6), 2 x 2 (q4), 3 x 3 (q8).
[[nodiscard]] std::span<const IntegrationPoint> integration_points(PlaneShape shape);

/// A point at which stresses of an element are most accurate: its centre (t3), one of 3 (t6) or 2 x 2 points (q4, q8).
struct StressPoint {
  double a = 0.0, b = 0.0;
};
[[nodiscard]] std::span<const StressPoint> stress_points(PlaneShape shape);
/// Weight of a stress point in the extrapolation to a node, by the (bi)linear function through all stress points.
[[nodiscard]] double extrapolation_weight(PlaneShape shape, std::size_t point, std::size_t node);

/// Coordinates (a, b) of a node.
[[nodiscard]] std::array<double, 2> node_coordinates(PlaneShape shape, std::size_t node);

/// The nodes of edge i of an element: two ends, then the middle if there is one.
[[nodiscard]] std::vector<int> edge_nodes(const PlaneMesh::Element& element, std::size_t i);

/// Shape functions of an edge of two or three nodes, and their derivatives with respect to s; the end nodes come first.
struct EdgeValues {
  std::array<double, 3> values{}, derivatives{};
};
[[nodiscard]] EdgeValues edge_shape_functions(std::size_t nodes, double s);

/// Points and weights of the five-point Gauss rule on [-1, 1]: exact up to degree 9.
struct EdgePoint {
  double s, weight;
};
[[nodiscard]] std::span<const EdgePoint> edge_points();

}  // namespace signorini::mesh
