#include "model/assembly/motion_names.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace signorini::assembly {

namespace {

constexpr double at_rest = 1e-3;  // relative to the largest motion: smaller motions are treated as zero

struct NodeMotion {
  const element::MeshNode* node;
  double x, y, turn;
  bool turns;  ///< true: the node has a rotation
};

/// Motions of all nodes; with `within`, of those nodes only that a degree of freedom with an entry in it moves.
std::vector<NodeMotion> node_motions(const Vector& motion, const DofMap& map,
                                     const Vector* within = nullptr) {
  std::vector<NodeMotion> result;
  auto component = [&](int number) { return map.value(motion, number); };
  for (std::size_t i = 0; i < map.number.size(); ++i) {
    const auto& d = map.number[i];
    if (d[0] == DofMap::absent && d[1] == DofMap::absent && d[2] == DofMap::absent) continue;
    if (within && map.value(*within, d[0]) == 0.0 && map.value(*within, d[1]) == 0.0 &&
        map.value(*within, d[2]) == 0.0)
      continue;
    result.push_back(
        {&map.mesh.nodes[i], component(d[0]), component(d[1]), component(d[2]), d[2] != DofMap::absent});
  }
  return result;
}

double rounded(double value, double size) { return std::abs(value) < at_rest * size ? 0.0 : value; }

std::string direction_name(double x, double y) {
  const double length = std::hypot(x, y);
  if (std::abs(y) < at_rest * length) return "horizontal motion";
  if (std::abs(x) < at_rest * length) return "vertical motion";
  const double sign = x < 0.0 ? -1.0 : 1.0;
  return fmt::format("motion along ({:.3g}, {:.3g})", sign * x / length, sign * y / length);
}

std::string name_of_largest_dof(const Vector& motion, const DofMap& map, double size, bool rotations) {
  int largest = -1;
  for (int i = 0; i < motion.size(); ++i) {
    if (map.dofs[static_cast<std::size_t>(i)].rotation != rotations) continue;
    if (largest < 0 || std::abs(motion[i]) > (1.0 + at_rest) * std::abs(motion[largest])) largest = i;
  }
  const std::string name = largest < 0 ? "" : map.dofs[static_cast<std::size_t>(largest)].displacement;
  int others = -1;
  for (int i = 0; i < motion.size(); ++i)
    if (map.dofs[static_cast<std::size_t>(i)].rotation == rotations && std::abs(motion[i]) > at_rest * size)
      ++others;
  return others > 0 ? fmt::format("motion of {} (and {} more)", name, others)
                    : fmt::format("motion of {}", name);
}

/// The rotation of the nodes; of nodes without rotations (plane elements) the one nearest to their translations.
double mean_rotation(const std::vector<NodeMotion>& nodes) {
  double theta = 0.0;
  for (const NodeMotion& m : nodes)
    if (m.turns && std::abs(m.turn) > std::abs(theta)) theta = m.turn;
  if (theta != 0.0) return theta;
  double x = 0.0, y = 0.0;
  for (const NodeMotion& m : nodes) {
    x += m.node->x / static_cast<double>(nodes.size());
    y += m.node->y / static_cast<double>(nodes.size());
  }
  double moment = 0.0, inertia = 0.0;
  for (const NodeMotion& m : nodes) {
    const double rx = m.node->x - x, ry = m.node->y - y;
    moment += rx * m.y - ry * m.x;
    inertia += rx * rx + ry * ry;
  }
  return inertia > 0.0 ? moment / inertia : 0.0;
}

/// True if all nodes rotate rigidly about one centre; `name` is then set to "rotation about (x, y)".
bool rigid_rotation(const std::vector<NodeMotion>& nodes, double size, double shown, std::string& name) {
  const double theta = mean_rotation(nodes);
  if (theta == 0.0) return false;
  // u = -theta (y - cy), v = theta (x - cx)
  const NodeMotion& first = nodes.front();
  const double cx = first.node->x - first.y / theta, cy = first.node->y + first.x / theta;
  for (const NodeMotion& m : nodes) {
    if (std::abs(m.x + theta * (m.node->y - cy)) > at_rest * size ||
        std::abs(m.y - theta * (m.node->x - cx)) > at_rest * size)
      return false;
    if (m.turns && std::abs(m.turn - theta) > at_rest * std::abs(theta)) return false;
  }
  double extent = 0.0;
  for (const NodeMotion& m : nodes) extent = std::max(extent, std::hypot(m.node->x - cx, m.node->y - cy));
  name = fmt::format("rotation about ({:.4g}, {:.4g})", rounded(cx, extent) * shown,
                     rounded(cy, extent) * shown);
  return true;
}

/// True if all nodes translate by the same vector without rotating.
bool translates(const std::vector<NodeMotion>& nodes, double size) {
  const NodeMotion& first = nodes.front();
  double turning = 0.0, extent = 0.0;  // a rotation that moves no node by at_rest * size is ignored
  for (const NodeMotion& m : nodes) {
    if (std::hypot(m.x - first.x, m.y - first.y) > at_rest * size) return false;
    turning = std::max(turning, std::abs(m.turn));
    extent = std::max(extent, std::hypot(m.node->x - first.node->x, m.node->y - first.node->y));
  }
  return turning * extent <= at_rest * size;
}

bool moves_rigidly(const Vector& motion, const DofMap& map, const std::vector<NodeMotion>& nodes) {
  const double size = max_translation(motion, map);
  std::string name;
  return !map.is_matrix_scene() && size > 0.0 && !nodes.empty() &&
         (translates(nodes, size) || rigid_rotation(nodes, size, map.message_length_factor, name));
}

/// A vector with entries at the degrees of freedom `dofs`, in no relation that could cancel in a tied node.
Vector indicator(const std::vector<int>& dofs, Eigen::Index size) {
  Vector within = Vector::Zero(size);
  for (const int i : dofs) within[i] = std::sqrt(2.0 + i);
  return within;
}

/// Describes the motion of these nodes.
std::string describe(const Vector& motion, const DofMap& map, const std::vector<NodeMotion>& nodes) {
  const double size = max_translation(motion, map);
  const double whole = motion.size() == 0 ? 0.0 : motion.cwiseAbs().maxCoeff();
  if (!(size > 0.0)) return name_of_largest_dof(motion, map, whole, true);
  if (map.is_matrix_scene()) return name_of_largest_dof(motion, map, size, false);
  int moving = 0;
  const NodeMotion* mover = nullptr;
  for (const NodeMotion& m : nodes)
    if (std::hypot(m.x, m.y) > at_rest * size && ++moving) mover = &m;
  if (!nodes.empty() && translates(nodes, size)) {
    const std::string name = direction_name(mover->x, mover->y);
    return nodes.size() == 1 ? fmt::format("{} of node '{}'", name, mover->node->name) : name;
  }
  std::string name;
  if (!nodes.empty() && rigid_rotation(nodes, size, map.message_length_factor, name)) return name;
  if (moving == 1)
    return fmt::format("{} of node '{}'", direction_name(mover->x, mover->y), mover->node->name);
  return name_of_largest_dof(motion, map, size, false);
}

}  // namespace

bool is_rigid(const Vector& motion, const DofMap& map) {
  return moves_rigidly(motion, map, node_motions(motion, map));
}

bool is_rigid(const Vector& motion, const DofMap& map, const std::vector<int>& dofs) {
  const Vector within = indicator(dofs, motion.size());
  return moves_rigidly(motion, map, node_motions(motion, map, &within));
}

double max_translation(const Vector& motion, const DofMap& map) {
  double size = 0.0;
  for (const NodeMotion& m : node_motions(motion, map)) size = std::max(size, std::hypot(m.x, m.y));
  if (map.is_matrix_scene() && motion.size() > 0) size = motion.cwiseAbs().maxCoeff();
  return size;
}

std::string describe_motion(const Vector& motion, const DofMap& map) {
  return describe(motion, map, node_motions(motion, map));
}

std::string describe_motion_of_part(const Vector& motion, const DofMap& map, const std::vector<int>& dofs) {
  const Vector within = indicator(dofs, motion.size());
  const std::vector<NodeMotion> nodes = node_motions(motion, map, &within);
  const std::string name = describe(motion, map, nodes);
  if (map.is_matrix_scene() || nodes.size() < 2) return name;
  return fmt::format("{} of the part with node '{}'", name, nodes.front().node->name);
}

}  // namespace signorini::assembly
