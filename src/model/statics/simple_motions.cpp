#include "model/statics/simple_motions.hpp"

#include <array>
#include <numeric>

#include "base/eigen_dense.hpp"

namespace signorini {
namespace {

constexpr double belongs = 1e-3;  // relative; a null motion of a fine mesh has few digits

/// Translations along x and y, and the rotation about the centre, on the given degrees of freedom.
std::array<Vector, 3> rigid_motions(const DofMap& map, const std::vector<int>& dofs) {
  std::array<Vector, 3> rigid;
  rigid.fill(Vector::Zero(map.size()));
  double x = 0.0, y = 0.0, count = 0.0;
  for (const int i : dofs) {
    const auto node = static_cast<std::size_t>(map.where[static_cast<std::size_t>(i)].first);
    x += map.mesh.nodes[node].x;
    y += map.mesh.nodes[node].y;
    count += 1.0;
  }
  for (const int i : dofs) {
    const auto [number, component] = map.where[static_cast<std::size_t>(i)];
    const MeshNode& node = map.mesh.nodes[static_cast<std::size_t>(number)];
    if (component < 2) rigid[static_cast<std::size_t>(component)][i] = 1.0;
    rigid[2][i] = component == 0 ? -(node.y - y / count) : component == 1 ? node.x - x / count : 1.0;
  }
  return rigid;
}

}  // namespace

Eigen::MatrixXd simple_motions(const Eigen::MatrixXd& motions, const DofMap& map) {
  std::vector<int> all(static_cast<std::size_t>(map.size()));
  std::iota(all.begin(), all.end(), 0);
  return simple_motions(motions, map, all);
}

Eigen::MatrixXd simple_motions(const Eigen::MatrixXd& motions, const DofMap& map,
                               const std::vector<int>& dofs) {
  if (map.matrices() || motions.cols() < 2) return motions;
  const Eigen::MatrixXd q = orthonormal(motions);
  Eigen::MatrixXd found(q.cols(), 0), basis(q.cols(), 0);  // coordinates in q; the same, orthonormal
  for (const Vector& rigid : rigid_motions(map, dofs)) {
    const Eigen::VectorXd c = q.transpose() * rigid;
    if (!((rigid - q * c).norm() <= belongs * rigid.norm()) || rigid.norm() == 0.0) continue;
    const Eigen::VectorXd rest = c - basis * (basis.transpose() * c);
    if (!(rest.norm() > belongs * c.norm())) continue;
    found.conservativeResize(Eigen::NoChange, found.cols() + 1);
    found.rightCols(1) = c;
    basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
    basis.rightCols(1) = rest.normalized();
  }
  if (found.cols() == 0) return motions;
  Eigen::MatrixXd result(q.rows(), q.cols());
  result.leftCols(found.cols()) = q * found;
  if (found.cols() < q.cols()) result.rightCols(q.cols() - found.cols()) = q * orthogonal_complement(found);
  return result;
}

}  // namespace signorini
