// mesh_motion.hpp: compression of mesh motions to a few shapes, for the page, and shapes of members.
//
//   u(x, t_j) = sum_k shape_k(x) part_k(t_j)
//   proper orthogonal decomposition: G = A^T A = W diag(s^2) W^T,  shapes A w_k,  parts w_k
//
// A: displacements of body_motion.csv, one column per time. Shapes are added until no displacement has an error above
// 1/1000 of the largest displacement, or until the size limit of the page is reached.
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
// k: 0 straight, 1 bent, 2 bent and hinged at a, 3 bent and hinged at b. The page and the files for ParaView take all
// shape functions from these rows.

/// The list `shapes`: rows of shape functions for each k.
[[nodiscard]] base::Json shapes_json();

/// Index k into shapes_json() for a piece of a member.
[[nodiscard]] int shape_of(const element::MemberLine& line);

/// Shape functions across the member, from a row of shapes_json().
[[nodiscard]] element::LineShapes across_of(const base::Json& row);

/// Magnification for nodes and curve of run_data(): the largest displacement is drawn with at most an eighth
/// of the structure's larger extent. greatest: largest displacement of nodes without a curve.
[[nodiscard]] double fitting_magnification(const base::Json& nodes, const base::Json& curve,
                                           double greatest = 0.0);

struct MeshMotion {
  std::vector<double> times;
  std::vector<int> nodes;  ///< indices into Scene::nodes
  Eigen::MatrixXd shapes;  ///< one column per shape: ux, uy of the first node, ...; largest entry 1
  Eigen::MatrixXd parts;   ///< one row per time, one column per shape: displacements are shapes parts^T
  double greatest = 0.0;   ///< largest displacement along x or y
};

/// Sets shapes, parts and greatest. displacements: rows as in shapes, one column per time. most: limit for the number of
/// entries of shapes and parts together; at least one shape is kept.
void decompose_motion(const Eigen::MatrixXd& displacements, std::size_t most, MeshMotion& motion);

/// Mesh motion of a run; `nodes` is empty if the directory has no body_motion.csv. Errors: FileError.
[[nodiscard]] MeshMotion mesh_motion(const Scene& scene, const std::filesystem::path& directory);

/// The motion as JSON for the page; null if `nodes` is empty.
[[nodiscard]] base::Json mesh_motion_json(const MeshMotion& motion);

}  // namespace signorini::report
