// mesh_motion.hpp: compression of mesh motions to a few shapes, for the page.
//
//   u(x, t_j) = sum_k shape_k(x) part_k(t_j),   proper orthogonal: G = A^T A = W diag(s^2) W^T,  shapes A w_k,  parts w_k
//
// A: displacements of body_motion.csv, one column per time. Shapes are added until no displacement has an error above
// 1/1000 of the largest one, or until the size limit of the page is reached.
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
  Eigen::MatrixXd parts;   ///< 2 nodes (ux, uy of the first, ...) x shapes; the largest entry of each is 1
  double greatest = 0.0;   ///< displacement along x or y
};

/// Decomposes displacements (2 nodes x times); most: limit for the entries of shapes and parts together.
void split_motion(const Eigen::MatrixXd& displacements, std::size_t most, MeshMotion& motion);

/// Result without nodes if the directory has no body_motion.csv. Errors: FileError.
[[nodiscard]] MeshMotion mesh_motion(const Scene& scene, const std::filesystem::path& directory);

/// JSON of the motion; null without nodes.
[[nodiscard]] Json mesh_motion_json(const MeshMotion& motion);

}  // namespace signorini
