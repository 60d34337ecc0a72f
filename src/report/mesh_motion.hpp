// mesh_motion.hpp: the motion of meshes as few shapes, for the page.
//
//   u(x, t_j) = sum_k shape_k(x) part_k(t_j),   proper orthogonal: G = A^T A = W diag(s^2) W^T,  shapes A w_k,  parts w_k
//
// A: displacements of body_motion.csv, a column a time. Shapes are added until no displacement is off by more than 1/1000
// of the greatest one, or until the page is full.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "base/json.hpp"
#include "signorini/scene.hpp"

namespace signorini {

struct MeshMotion {
  std::vector<double> times;
  std::vector<int> nodes;  ///< indices into Scene::nodes
  Eigen::MatrixXd shapes;  ///< 2 nodes (ux, uy of the first, ...) x shapes; the greatest entry of each is 1
  Eigen::MatrixXd parts;   ///< times x shapes, length
  double greatest = 0.0;   ///< displacement along x or y
};

/// Of displacements (2 nodes x times); most: entries of shapes and parts together.
void split_motion(const Eigen::MatrixXd& displacements, std::size_t most, MeshMotion& motion);

/// Without nodes where the directory has no body_motion.csv. Errors: FileError.
[[nodiscard]] MeshMotion mesh_motion(const Scene& scene, const std::filesystem::path& directory);

/// Null without nodes.
[[nodiscard]] Json mesh_motion_json(const MeshMotion& motion);

}  // namespace signorini
