// mesh_motion.hpp: compression of mesh motions to a few shapes, for the page, and shapes of members.
//
//   u(x, t_j) = sum_k shape_k(x) part_k(t_j)
//   proper orthogonal decomposition: G = A^T A = W diag(s^2) W^T,  shapes A w_k,  parts w_k
//
// A: displacements of body_motion.csv, one column per time. Shapes are added until no displacement has an error above
// 1/1000 of the largest one, or until the size limit of the page is reached.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "base/json.hpp"
#include "model/element/element_kinds.hpp"
#include "signorini/scene.hpp"

namespace signorini::report {

// Data for drawing members between named nodes, for the page and ParaView.
//
//   shapes[k]  rows s, a, rotation_a, b, rotation_b
//   across the member   v(s) = a v_a + b v_b + L (rotation_a rz_a + rotation_b rz_b);   along it linear
//
// k: 0 straight, 1 bent, 2 bent and hinged at a, 3 hinged at b. Page and ParaView know the shape functions
// only from these rows.

/// The rows of all shapes[k].
[[nodiscard]] base::Json shapes_json();

/// Index into shapes_json().
[[nodiscard]] int shape_of(const element::MemberLine& line);

/// Shape functions across the line, from a row.
[[nodiscard]] element::LineShapes across_of(const base::Json& row);

/// Magnification for nodes and curve of run_data(): the largest displacement is drawn with at most an eighth
/// of the structure's larger extent. greatest: largest displacement of nodes without a curve.
[[nodiscard]] double fitting_magnification(const base::Json& nodes, const base::Json& curve,
                                           double greatest = 0.0);

struct MeshMotion {
  std::vector<double> times;
  std::vector<int> nodes;  ///< indices into Scene::nodes
  Eigen::MatrixXd shapes;  ///< 2 nodes (ux, uy of the first, ...) x shapes; the largest entry of each is 1
  Eigen::MatrixXd parts;   ///< times x shapes: displacements are shapes parts^T
  double greatest = 0.0;   ///< largest displacement along x or y
};

/// Decomposes displacements (2 nodes x times); most: limit for the entries of shapes and parts together.
void decompose_motion(const Eigen::MatrixXd& displacements, std::size_t most, MeshMotion& motion);

/// Mesh motion of a run; without nodes if the directory has no body_motion.csv. Errors: FileError.
[[nodiscard]] MeshMotion mesh_motion(const Scene& scene, const std::filesystem::path& directory);

/// JSON of the motion; null without nodes.
[[nodiscard]] base::Json mesh_motion_json(const MeshMotion& motion);

}  // namespace signorini::report
