#include "model/assembly/moving_obstacles.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"

namespace signorini::assembly {
namespace {

/// A sum of motions of supports.
class ObstacleMotion {
 public:
  /// Adds the part of a motion that moving supports determine.
  void add(const DofMap& map, int number, double factor) {
    for (const TiedTerm& term : map.terms(number))
      if (term.number < 0) add(term.number, factor * term.factor);
  }
  [[nodiscard]] std::vector<TiedTerm> terms(double factor) const {
    std::vector<TiedTerm> result;
    for (const Sum& s : sums_)
      if (std::abs(s.term.factor) > rounding::few_operations * s.size)
        result.push_back({s.term.number, factor * s.term.factor});
    return result;
  }

 private:
  struct Sum {
    TiedTerm term;
    double size = 0.0;
  };
  void add(int number, double factor) {
    auto same =
        std::find_if(sums_.begin(), sums_.end(), [&](const Sum& s) { return s.term.number == number; });
    if (same == sums_.end()) same = sums_.insert(sums_.end(), Sum{{number, 0.0}});
    same->term.factor += factor;
    same->size += std::abs(factor);
  }
  std::vector<Sum> sums_;
};

std::size_t slot(int node) { return static_cast<std::size_t>(node); }

/// All nodes that move with a node: those of its rigid body, the centre included.
std::vector<int> nodes_moving_with(const DofMap& map, int node) {
  const int body = map.body[slot(node)];
  if (body == DofMap::absent) return {node};
  std::vector<int> nodes;
  for (std::size_t i = 0; i < map.body.size(); ++i)
    if (map.body[i] == body) nodes.push_back(static_cast<int>(i));
  return nodes;
}

/// The degree of freedom of a component of a node, or of the centre of its rigid body; `absent` if supports, a seam or an
/// obstacle determine the component.
int free_motion(const DofMap& map, int node, std::size_t c) {
  for (const int other : nodes_moving_with(map, node))
    if (const int n = map.number[slot(other)][c]; n >= 0 && !map.is_tied(n)) return n;
  return DofMap::absent;
}

/// "ball.uy" -> "ball-table.uy".
std::string relative_name(const std::string& name, const std::string& obstacle) {
  const std::size_t point = name.rfind('.');
  return name.substr(0, point) + "-" + obstacle + name.substr(point);
}

void make_relative(DofMap& map, int node, std::size_t c, const std::vector<TiedTerm>& obstacle,
                   const std::string& obstacle_name) {
  const int own = free_motion(map, node, c);
  Dof& dof = map.dofs[slot(own)];
  dof.displacement = relative_name(dof.displacement, obstacle_name);
  dof.velocity = relative_name(dof.velocity, obstacle_name);
  for (const int other : nodes_moving_with(map, node)) {
    const int n = map.number[slot(other)][c];
    std::vector<TiedTerm> terms = map.terms(n);
    terms.insert(terms.end(), obstacle.begin(), obstacle.end());
    if (map.is_tied(n))
      map.tied[slot(n - map.size())].terms = std::move(terms);
    else if (n >= 0)
      map.tie(other, c, std::move(terms));
  }
}

/// The nodes of one contact, and the components along which it acts.
class ObstacleContact {
 public:
  ObstacleContact(const ContactSpec& spec, const DofMap& map)
      : spec_(spec), direction_(spec.normal ? *spec.normal : *spec.tangent) {
    const std::string key = spec.key(spec.normal ? "normal" : "tangent");
    node_ = element::find_node(map.mesh, direction_.node, direction_.place, key);
    for (const auto& [name, weight] : direction_.against)
      against_.emplace_back(element::find_node(map.mesh, name, direction_.place, key), weight);
    const auto normal = spec.normal ? clean_direction(spec.normal->vector) : std::array{0.0, 0.0},
               tangent = sliding_direction(spec);
    for (std::size_t c = 0; c < 2; ++c) acts_[c] = normal[c] != 0.0 || tangent[c] != 0.0;
  }

  /// Makes motions relative where the two sides differ by motions of supports. Returns true if it changed the map.
  bool follow(const Scene& scene, DofMap& map) const {
    bool changed = false;
    for (std::size_t c = 0; c < 2; ++c) {
      if (!acts_[c]) continue;
      ObstacleMotion between;
      between.add(map, map.numbers_at(node_)[c], 1.0);
      for (const auto& [node, weight] : against_) between.add(map, map.numbers_at(node)[c], -weight);
      if (between.terms(1.0).empty()) continue;
      changed = true;
      if (!against_.empty() && free_motion(map, node_, c) >= 0) {
        make_relative(map, node_, c, between.terms(-1.0), direction_.against.front().first);
        continue;
      }
      const bool others_free =
          !against_.empty() && std::all_of(against_.begin(), against_.end(), [&](const auto& side) {
            return free_motion(map, side.first, c) >= 0;
          });
      if (!others_free) {
        const int moving = DofMap::support_of_code(between.terms(1.0).front().number);
        refuse(scene.supports[map.supports[slot(moving)]], c);
      }
      for (const auto& [node, weight] : against_)
        if (free_motion(map, node, c) >= 0)  // two nodes may be of one rigid body
          make_relative(map, node, c, between.terms(1.0), direction_.node);
    }
    return changed;
  }

 private:
  /// support: one that moves one side of the contact, but not the other.
  [[noreturn]] void refuse(const Support& support, std::size_t c) const {
    throw SceneError(direction_.place, spec_.key(spec_.normal ? "normal" : "tangent"),
                     fmt::format("a support moves node '{0}' in {1}, and only one side of this contact moves "
                                 "with it, so the gap would "
                                 "depend on time, not on degrees of freedom alone; the node that touches "
                                 "'{0}' must be free in {1} and "
                                 "touch nothing else there; if all supports move together, give "
                                 "[base_motion] instead of their motion",
                                 support.node, c == 0 ? "x" : "y"));
  }

  const ContactSpec& spec_;
  const Direction& direction_;
  int node_ = 0;
  std::vector<std::pair<int, double>> against_;
  std::array<bool, 2> acts_{};
};

}  // namespace

void follow_obstacles(const Scene& scene, DofMap& map) {
  if (map.supports.empty()) return;
  std::vector<ObstacleContact> contacts;
  for (const ContactSpec& spec : scene.contacts)
    if (spec.normal || spec.tangent) contacts.emplace_back(spec, map);
  // A node that touches one with a relative motion has a relative motion, too. Each round gives at least one component its
  // obstacle.
  for (bool changed = true; changed;) {
    changed = false;
    for (const ObstacleContact& contact : contacts) changed = contact.follow(scene, map) || changed;
  }
}

std::vector<RelativeMotion> relative_motions(const DofMap& map) {
  std::vector<RelativeMotion> result;
  for (std::size_t node = 0; node < map.number.size(); ++node)
    for (std::size_t c = 0; c < 2; ++c) {
      const int n = map.number[node][c], own = map.own_number(static_cast<int>(node), c);
      if (own < 0 || own == n) continue;
      RelativeMotion& motion = result.emplace_back(RelativeMotion{own, {}});
      for (const TiedTerm& term : map.terms(n))
        if (term.number < 0) motion.obstacle.push_back(term);
    }
  return result;
}

}  // namespace signorini::assembly
