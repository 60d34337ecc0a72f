#include "model/outputs/reactions.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "model/assembly/ties.hpp"
#include "model/outputs/structure_rows.hpp"

namespace signorini::outputs {
namespace {

/// Largest distance of a node of the body from its centre; 1 if all nodes are at the centre.
double size_of_body(const assembly::DofMap& map, const std::vector<int>& nodes,
                    const element::MeshNode& centre) {
  double size = 0.0;
  for (const int n : nodes) {
    const element::MeshNode& at = map.mesh.nodes[static_cast<std::size_t>(n)];
    size = std::max(size, std::hypot(at.x - centre.x, at.y - centre.y));
  }
  return size > 0.0 ? size : 1.0;
}

/// Resultant (fx, fy, moment about the centre) of a unit force along component c at a node. The moment is divided by `size`.
Eigen::Vector3d resultant(const assembly::DofMap& map, int node, std::size_t c,
                          const element::MeshNode& centre, double size) {
  const element::MeshNode& at = map.mesh.nodes[static_cast<std::size_t>(node)];
  if (c == 0) return {1.0, 0.0, -(at.y - centre.y) / size};
  if (c == 1) return {0.0, 1.0, (at.x - centre.x) / size};
  return {0.0, 0.0, 1.0 / size};
}

}  // namespace

std::vector<int> nodes_of_body(const assembly::DofMap& map, int body) {
  std::vector<int> nodes;
  for (std::size_t i = 0; i < map.body.size(); ++i)
    if (map.body[i] == body) nodes.push_back(static_cast<int>(i));
  return nodes;
}

void add_body_reaction(const Scene& scene, const assembly::DofMap& map, const StructureRows& rows,
                       const BodyReaction& asked, PhysicalRow& row) {
  const RigidBody& body = scene.rigid[static_cast<std::size_t>(asked.body)];
  const element::MeshNode& centre =
      map.mesh.nodes[static_cast<std::size_t>(map.mesh.by_name.at(body.centre))];
  const std::vector<int> nodes = nodes_of_body(map, asked.body);
  const double size = size_of_body(map, nodes, centre);
  const auto held = assembly::constrained_components(scene, map, asked.body);
  Eigen::MatrixXd g(3, static_cast<Eigen::Index>(held.size()));
  Vector along = Vector::Zero(g.cols());  // contribution of each support to the requested reaction
  for (std::size_t j = 0; j < held.size(); ++j) {
    const auto [node, c] = held[j];
    const auto at = static_cast<Eigen::Index>(j);
    g.col(at) = resultant(map, node, c, centre, size);
    if (node == asked.node) along[at] = asked.d[c];
  }
  const Eigen::MatrixXd square = g.transpose() * g;
  const Eigen::MatrixXd angles = g.colwise().normalized().transpose() * g.colwise().normalized();
  if (!(base::symmetric_eigen(angles).values[0] > rounding::many_operations))
    throw SceneError(asked.place, asked.key,
                     fmt::format("the reactions of the supports of rigid body '{}' are statically "
                                 "indeterminate: expected at most three supports, in independent directions",
                                 body.name));
  const Eigen::Vector3d weights = g * base::solve_dense(square, along);
  for (const int node : nodes)
    for (std::size_t c = 0; c < 3; ++c)
      if (const double factor = weights.dot(resultant(map, node, c, centre, size)); factor != 0.0)
        rows.add_reaction(row, node, c, factor);
  if (map.body_stiffness.empty()) return;
  const int turn = map.numbers_at(map.mesh.by_name.at(body.centre))[2];
  rows.add_motion(row, turn, weights[2] / size * map.body_stiffness[static_cast<std::size_t>(asked.body)],
                  0.0, 0.0);
}

namespace {

constexpr double usual_variability =
    0.25;  // limit of variability() in the piping codes MSS SP-58 and ASME B31.1

}  // namespace

void find_hangers(const Scene& scene, const assembly::DofMap& map, Model& model) {
  std::optional<StructureRows> rows;
  for (std::size_t i = 0; i < scene.springs.size(); ++i) {
    const Spring& spring = scene.springs[i];
    if (spring.preload == 0.0) continue;
    if (!rows) rows.emplace(scene, map, 0.0, 0.0);
    Spring elastic = spring;
    elastic.damping = 0.0;
    PhysicalRow row(map.size());
    rows->add_spring(row, elastic, false, 1.0);
    double force = row.constant + row.u.dot(model.u0);
    for (const Output::Given& given : row.given) force += given.history.value(0.0);
    model.hangers.push_back({i + 1, spring.preload, force, spring.hot_load});
  }
}

double variability(const HangerLoad& hanger) {
  return hanger.at_start == 0.0 ? std::numeric_limits<double>::infinity()
                                : std::abs(hanger.cold - hanger.at_start) / std::abs(hanger.at_start);
}

std::vector<std::string> hanger_warnings(const Scene& scene, const Model& model) {
  std::vector<std::string> warnings;
  for (const HangerLoad& h : model.hangers) {
    const Spring& spring = scene.springs[h.spring - 1];
    const double along = spring.direction[0] * scene.gravity[0] + spring.direction[1] * scene.gravity[1];
    // The force on the node is -cold times the direction.
    if (h.hot && h.cold * along < 0.0)
      warnings.push_back(
          fmt::format("the hanger of spring {} pushes its node along gravity; reverse the direction of the "
                      "spring: it must point from the hanger's anchor to the node",
                      h.spring));
  }
  if (!model.static_start) return warnings;
  for (const HangerLoad& h : model.hangers) {
    const double cold = h.cold * model.unit.force, now = h.at_start * model.unit.force;
    const std::string& unit = model.units.force;
    if ((cold > 0.0) != (now > 0.0))
      warnings.push_back(
          fmt::format("spring {} carries {:.6g} {} in equilibrium and {:.6g} {} in the undeformed state: the "
                      "sign differs; check the preload",
                      h.spring, now, unit, cold, unit));
    else if (variability(h) > usual_variability)
      warnings.push_back(
          fmt::format("spring {} carries {:.6g} {} in equilibrium and {:.6g} {} in the undeformed state: its "
                      "variability is {:.3g} %, above the usual limit of 25 %",
                      h.spring, now, unit, cold, unit, 100.0 * variability(h)));
  }
  return warnings;
}

}  // namespace signorini::outputs
