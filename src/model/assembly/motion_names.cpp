#include "model/assembly/motion_names.hpp"

#include <fmt/core.h>

#include <cmath>

namespace signorini {
namespace {

constexpr double at_rest = 1e-3;  // relative; a null motion of a fine mesh has few digits

struct NodeMotion {
  const MeshNode* node;
  double x, y, turn;
  bool turns;  ///< the node has a rotation
};

std::vector<NodeMotion> node_motions(const Vector& motion, const DofMap& map) {
  std::vector<NodeMotion> result;
  auto component = [&](int number) { return map.value(motion, number); };
  for (std::size_t i = 0; i < map.number.size(); ++i) {
    const auto& d = map.number[i];
    if (d[0] == DofMap::absent && d[1] == DofMap::absent && d[2] == DofMap::absent) continue;
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

std::string largest_name(const Vector& motion, const DofMap& map, double size, bool rotations) {
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

/// Angle and centre of a rigid rotation of all nodes, if the motion is one.
bool rigid_rotation(const std::vector<NodeMotion>& nodes, double size, double shown, std::string& name) {
  double theta = 0.0;
  for (const NodeMotion& m : nodes)
    if (m.turns && std::abs(m.turn) > std::abs(theta)) theta = m.turn;
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
  double turning = 0.0, extent = 0.0;  // a rotation that moves no node by at_rest counts as none
  for (const NodeMotion& m : nodes) {
    if (std::hypot(m.x - first.x, m.y - first.y) > at_rest * size) return false;
    turning = std::max(turning, std::abs(m.turn));
    extent = std::max(extent, std::hypot(m.node->x - first.node->x, m.node->y - first.node->y));
  }
  return turning * extent <= at_rest * size;
}

}  // namespace

bool is_rigid(const Vector& motion, const DofMap& map) {
  const double size = greatest_translation(motion, map);
  if (map.matrices() || !(size > 0.0)) return false;
  const auto nodes = node_motions(motion, map);
  std::string name;
  return translates(nodes, size) || rigid_rotation(nodes, size, map.shown_length, name);
}

double greatest_translation(const Vector& motion, const DofMap& map) {
  double size = 0.0;
  for (const NodeMotion& m : node_motions(motion, map)) size = std::max(size, std::hypot(m.x, m.y));
  if (map.matrices() && motion.size() > 0) size = motion.cwiseAbs().maxCoeff();
  return size;
}

std::string describe_motion(const Vector& motion, const DofMap& map) {
  const double size = greatest_translation(motion, map);
  const double whole = motion.size() == 0 ? 0.0 : motion.cwiseAbs().maxCoeff();
  if (!(size > 0.0)) return largest_name(motion, map, whole, true);
  if (map.matrices()) return largest_name(motion, map, size, false);
  const auto nodes = node_motions(motion, map);
  int moving = 0;
  const NodeMotion* mover = nullptr;
  for (const NodeMotion& m : nodes)
    if (std::hypot(m.x, m.y) > at_rest * size && ++moving) mover = &m;
  if (translates(nodes, size)) {
    const std::string name = direction_name(mover->x, mover->y);
    return nodes.size() == 1 ? fmt::format("{} of node '{}'", name, mover->node->name) : name;
  }
  std::string name;
  if (rigid_rotation(nodes, size, map.shown_length, name)) return name;
  if (moving == 1)
    return fmt::format("{} of node '{}'", direction_name(mover->x, mover->y), mover->node->name);
  return largest_name(motion, map, size, false);
}

}  // namespace signorini
