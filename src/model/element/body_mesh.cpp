#include "model/element/body_mesh.hpp"

#include <fmt/core.h>

#include <Eigen/LU>  // inverses of small matrices
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace signorini::element {
namespace {

/// Weights w_bi: index of the node i, and weight.
using Shares = std::vector<std::pair<int, double>>;

/// Moves the mass of massless nodes of a body to nodes near them; computes the weights w_bi.
class MassMover {
 public:
  MassMover(const Mesh& mesh, const BodySpec& body) : mesh_(mesh), body_(body) {
    off_.insert(body.massless.begin(), body.massless.end());
    for (const PlaneMesh::Element& e : body.mesh.elements)
      for (const int n : e.nodes) around_[n].insert(e.nodes.begin(), e.nodes.end());
  }

  [[nodiscard]] bool is_off(int node) const { return off_.contains(node); }

  [[nodiscard]] const Shares& shares(int node) {
    const auto [found, first] = shares_.try_emplace(node);
    if (first) found->second = is_off(node) ? least_norm_shares(node) : Shares{{node, 1.0}};
    return found->second;
  }

 private:
  Shares least_norm_shares(int node) const {
    std::set<int> reached{node};
    for (int ring = 0; ring < 4; ++ring) {
      std::set<int> next = reached;
      for (const int n : reached) next.insert(around_.at(n).begin(), around_.at(n).end());
      reached = std::move(next);
      std::vector<int> near;
      for (const int n : reached)
        if (!is_off(n)) near.push_back(n);
      if (near.size() < 3) continue;
      if (Shares shares = weights_of(node, near); !shares.empty()) return shares;
    }
    throw SceneError(
        body_.place, fmt::format("bodies.{}", body_.name),
        fmt::format("the mass of node '{}' cannot be moved: it needs three nearby nodes with mass that are "
                    "not on one line; use a finer mesh, or remove contact_mass = \"none\"",
                    mesh_.node(node).name));
  }

  /// Least-norm w with A w = (1, 0, 0), where A has the rows 1, x - x_b, y - y_b; empty if A is rank deficient.
  [[nodiscard]] Shares weights_of(int node, const std::vector<int>& near) const {
    const MeshNode& at = mesh_.node(node);
    Eigen::MatrixXd a(3, static_cast<Eigen::Index>(near.size()));
    double size = 0.0;
    for (std::size_t i = 0; i < near.size(); ++i) {
      const MeshNode& n = mesh_.node(near[i]);
      a.col(static_cast<Eigen::Index>(i)) << 1.0, n.x - at.x, n.y - at.y;
      size = std::max(size, std::hypot(n.x - at.x, n.y - at.y));
    }
    a.bottomRows<2>() /= size;
    const Eigen::Matrix3d square = a * a.transpose();
    // Coordinates are divided by the largest distance. Nodes that are closer to a common line would have weights
    // of some thousands.
    constexpr double flat = 1e-6;
    if (square.determinant() <= flat) return {};
    const Eigen::VectorXd w = a.transpose() * (square.inverse() * Eigen::Vector3d(1.0, 0.0, 0.0));
    Shares shares;
    for (std::size_t i = 0; i < near.size(); ++i)
      shares.emplace_back(near[i], w[static_cast<Eigen::Index>(i)]);
    return shares;
  }

  const Mesh& mesh_;
  const BodySpec& body_;
  std::set<int> off_;
  std::map<int, std::set<int>> around_;
  std::map<int, Shares> shares_;
};

MovedMass moved_mass(const std::vector<int>& nodes, MassMover& mover) {
  MovedMass moved;
  std::map<int, Eigen::Index> column;
  for (const int n : nodes)
    for (const auto& [other, weight] : mover.shares(n))
      if (column.try_emplace(other, static_cast<Eigen::Index>(moved.nodes.size())).second)
        moved.nodes.push_back(other);
  moved.weights.setZero(static_cast<Eigen::Index>(2 * nodes.size()),
                        static_cast<Eigen::Index>(2 * moved.nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const auto& [other, weight] : mover.shares(nodes[i]))
      for (const Eigen::Index c : {0, 1})
        moved.weights(static_cast<Eigen::Index>(2 * i) + c, 2 * column[other] + c) = weight;
  return moved;
}

}  // namespace

PlaneMaterial material_of(const BodySpec& body) {
  return {body.E, body.nu, body.density, body.thickness, body.plane_strain};
}

void mesh_body(Mesh& mesh, const Scene& scene, std::size_t number) {
  const BodySpec& body = scene.bodies[number];
  const PlaneMaterial material = material_of(body);
  const auto owner = static_cast<int>(scene.members.size() + number);
  const std::size_t first = mesh.elements.size();
  for (const PlaneMesh::Element& e : body.mesh.elements) {
    std::vector<PlaneVector> at;
    for (const int n : e.nodes) at.push_back({mesh.node(n).x, mesh.node(n).y});
    mesh.elements.push_back(
        std::make_shared<PlaneElement>(e.nodes, owner, e.shape, std::move(at), material, body.mass));
  }
  if (body.massless.empty()) return;
  MassMover mover(mesh, body);
  for (std::size_t i = 0; i < body.mesh.elements.size(); ++i) {
    const std::vector<int>& nodes = body.mesh.elements[i].nodes;
    if (std::any_of(nodes.begin(), nodes.end(), [&](int n) { return mover.is_off(n); }))
      mesh.moved.emplace(first + i, moved_mass(nodes, mover));
  }
}

}  // namespace signorini::element
