#include "model/assembly/prestress.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <map>

#include "base/rounding.hpp"
#include "contact/curved_surface.hpp"
#include "model/assembly/loads.hpp"
#include "model/assembly/member_pieces.hpp"
#include "model/assembly/ties.hpp"
#include "scene/components.hpp"

namespace signorini::assembly {
namespace {

constexpr double no_force = 1e-9;  // relative to the forces on a body: smaller resultants are solver errors

using Plane = std::array<double, 2>;

std::array<double, 2> unit_of(const Plane& v) {
  const auto clean = clean_direction(v);
  const double length = std::hypot(clean[0], clean[1]);
  return length > 0.0 ? Plane{clean[0] / length, clean[1] / length} : Plane{0.0, 0.0};
}

/// Computes the prestress from the forces on the nodes, except the forces of supports and the internal forces of rigid
/// bodies.
class PrestressAssembly {
 public:
  PrestressAssembly(const Scene& scene, const DofMap& map, const Model& model, const StaticForces& standing)
      : scene_(scene), map_(map), standing_(standing), node_forces_(map.mesh.nodes.size(), Plane{0.0, 0.0}) {
    for (std::size_t i = 0; i < map.supports.size(); ++i)
      supports_.push_back(motion_of_support(scene, map, static_cast<int>(i)).value(0.0));
    double weight = 1.0;  // fraction of gravity that acts
    std::vector<double> bases;
    for (std::size_t i = 0; i < model.loads.size(); ++i) {
      const Load& load = model.loads[i];
      const double value = standing.acts[i] ? load.history.value(0.0) : 0.0;
      if (load.kind == LoadKind::weight)
        weight = value;
      else if (load.kind == LoadKind::base)
        bases.push_back(value);
      else
        values_[{is_strain(load.kind), load.name}] += value;
    }
    for (std::size_t c = 0; c < 2; ++c) {
      body_acceleration_[c] = weight * scene.gravity[c];
      for (std::size_t i = 0; i < bases.size(); ++i)
        body_acceleration_[c] += bases[i] * scene.base_motion[i].direction.vector[c];
    }
    for (std::size_t k = 0; k < model.contacts.size(); ++k) {
      const Contact& contact = model.contacts[k];
      restoring_forces_.push_back(contact::extra_stiffness(scene.contacts[k], contact) *
                                  contact.tangent.dot(standing.u));
    }
  }

  Prestress all() {
    distribute_loads();
    Prestress forces;
    for (std::size_t i = 0; i < map_.mesh.elements.size(); ++i) forces.elements.push_back(element(i));
    for (const PointMass& m : scene_.masses) add(m.node, body_acceleration_, m.mass);
    for (std::size_t i = 0; i < scene_.springs.size(); ++i) add_spring(i);
    for (std::size_t k = 0; k < scene_.contacts.size(); ++k) add_contact(k);
    for (std::size_t i = 0; i < scene_.rigid.size(); ++i)
      forces.bodies.push_back({scene_.rigid[i].name, body(i)});
    return forces;
  }

 private:
  static bool is_strain(LoadKind kind) {
    return kind == LoadKind::temperature || kind == LoadKind::initial_strain;
  }
  [[nodiscard]] double value_of(bool strain, const std::string& name) const {
    const auto found = values_.find({strain, name});
    return found == values_.end() ? 0.0 : found->second;
  }
  [[nodiscard]] double moved(int number) const {
    double sum = 0.0;
    for (const TiedTerm& term : map_.terms(number))
      sum += term.factor * (term.number >= 0
                                ? standing_.u[term.number]
                                : supports_[static_cast<std::size_t>(DofMap::support_of_code(term.number))]);
    return sum;
  }
  void add(const std::string& node, const Plane& force, double factor) {
    Plane& sum = node_forces_[static_cast<std::size_t>(map_.mesh.by_name.at(node))];
    for (std::size_t c = 0; c < 2; ++c) sum[c] += factor * force[c];
  }

  void distribute_loads() {
    uniform_.assign(map_.mesh.elements.size(), Plane{0.0, 0.0});
    for (std::size_t i = 0; i < scene_.loads.size(); ++i) {
      const LoadSpec& load = scene_.loads[i];
      const double value = value_of(false, name_of(load, i + 1));
      if (load.type == LoadType::force) add(load.direction.node, load.direction.vector, value);
      for (std::size_t j = 0; j + 1 < load.pieces.size(); ++j) {
        const auto [piece, backwards] =
            piece_between(map_, load.pieces[j], load.pieces[j + 1], load.place, "loads");
        for (std::size_t e = piece->first; e < piece->first + piece->count; ++e) {
          const Plane q = along_line(load, map_.mesh.line(e).axis(), backwards);
          for (std::size_t c = 0; c < 2; ++c) uniform_[e][c] += value * q[c];
        }
      }
    }
  }

  [[nodiscard]] std::string element_owner(int member) const {
    const auto i = static_cast<std::size_t>(member);
    return i < scene_.members.size()
               ? fmt::format("members.{}", i + 1)
               : fmt::format("body '{}'", scene_.bodies[i - scene_.members.size()].name);
  }

  Prestress::Element element(std::size_t i) {
    const element::FiniteElement& e = map_.mesh.element(i);
    if (!e.has_geometric_stiffness())
      throw SceneError(
          scene_.run.geometric_place, "run.geometric",
          fmt::format(
              "the elements of {} have no geometric stiffness: expected a structure of beams and bars",
              element_owner(e.member())));
    const element::PlaneVector& load = uniform_[i];
    add_to_nodes(e, e.load_vector({load[0] + e.density() * body_acceleration_[0],
                                   load[1] + e.density() * body_acceleration_[1]}));
    Prestress::Element result{map_.mesh.node(e.nodes().front()).name, map_.mesh.node(e.nodes().back()).name};
    if (map_.within_body(e)) return result;
    const std::vector<int> numbers = map_.element_numbers(i);
    element::ElementVector u(static_cast<Eigen::Index>(numbers.size()));
    for (std::size_t j = 0; j < numbers.size(); ++j) u[static_cast<Eigen::Index>(j)] = moved(numbers[j]);
    const double strain = value_of(true, name_of_strain(LoadKind::temperature, e.member())) +
                          value_of(true, name_of_strain(LoadKind::initial_strain, e.member()));
    add_to_nodes(e, strain * e.strain_forces() - e.stiffness() * u);
    const element::AxialForces forces = e.axial_forces(u, strain, load, body_acceleration_);
    result.at_from = forces.a;
    result.at_to = forces.b;
    return result;
  }

  void add_to_nodes(const element::FiniteElement& e, const element::ElementVector& forces) {
    const std::vector<element::ElementUnknown> unknowns = e.unknowns();
    for (std::size_t j = 0; j < unknowns.size(); ++j)
      if (const std::size_t c = unknowns[j].component; c < 2)
        node_forces_[static_cast<std::size_t>(e.nodes()[unknowns[j].local_node])][c] +=
            forces[static_cast<Eigen::Index>(j)];
  }

  /// True for a spring between nodes of one body: it rotates with the body, and its two end forces
  /// have no resultant moment.
  [[nodiscard]] bool is_within_body(const Spring& spring) const {
    return !spring.against.empty() &&
           map_.in_one_body({map_.mesh.by_name.at(spring.node), map_.mesh.by_name.at(spring.against)});
  }

  void add_spring(std::size_t i) {
    const Spring& spring = scene_.springs[i];
    if (is_within_body(spring)) return;
    const Plane d = unit_of(spring.direction);
    double elongation = 0.0;
    const auto take = [&](const std::string& node, double sign) {
      const auto numbers = map_.numbers_at(map_.mesh.by_name.at(node));
      for (std::size_t c = 0; c < 2; ++c)
        if (d[c] != 0.0) elongation += sign * d[c] * moved(numbers[c]);
    };
    take(spring.node, 1.0);
    if (!spring.against.empty()) take(spring.against, -1.0);
    const double force = value_of(false, name_of_preload(i)) + spring.stiffness * elongation;
    add(spring.node, d, -force);
    if (!spring.against.empty()) add(spring.against, d, force);
  }

  void add_contact(std::size_t k) {
    const ContactSpec& spec = scene_.contacts[k];
    const Direction* at = spec.normal ? &*spec.normal : spec.tangent ? &*spec.tangent : nullptr;
    if (at == nullptr) return;
    Plane force{0.0, 0.0};
    const auto take = [&](const Plane& direction, double size) {
      const Plane d = unit_of(direction);
      for (std::size_t c = 0; c < 2; ++c) force[c] -= size * d[c];
    };
    if (const Direction* normal = spec.bearing_normal()) take(normal->vector, standing_.N[k]);
    take(sliding_direction(spec), standing_.T[k] + restoring_forces_[k]);
    add(at->node, force, 1.0);
    for (const auto& [name, weight] : at->against) add(name, force, -weight);
  }

  /// Coordinate at which supports of a body fix component c: x for ux, y for uy. Without such a support: the coordinate of
  /// the centre.
  [[nodiscard]] double origin(std::size_t number, std::size_t c, const Plane& total,
                              const Plane& size) const {
    const RigidBody& body = scene_.rigid[number];
    const auto at = [&](int node) {
      const element::MeshNode& n = map_.mesh.nodes[static_cast<std::size_t>(node)];
      return c == 0 ? n.x : n.y;
    };
    std::optional<double> held;
    for (const auto& [node, component] : constrained_components(scene_, map_, static_cast<int>(number))) {
      if (component != c) continue;
      if (held && *held != at(node) && std::abs(total[c]) > no_force * size[c])
        throw SceneError(
            scene_.run.geometric_place, "run.geometric",
            fmt::format("several supports of rigid body '{}' fix its {}, so their reactions and "
                        "the geometric stiffness of the body are undetermined; keep only one of them",
                        body.name, scene::plane_components[c].displacement));
      if (!held) held = at(node);
    }
    return held.value_or(at(map_.mesh.by_name.at(body.centre)));
  }

  /// Geometric stiffness sum F . r of a rigid body. r is measured from origin(), where reactions act, so that reactions
  /// contribute nothing.
  [[nodiscard]] double body(std::size_t number) const {
    const auto owner = static_cast<int>(number);
    const int centre = map_.mesh.by_name.at(scene_.rigid[number].centre);
    if (map_.numbers_at(centre)[2] == DofMap::fixed) return 0.0;
    Plane total{0.0, 0.0}, size{0.0, 0.0};
    for (std::size_t node = 0; node < map_.body.size(); ++node)
      for (std::size_t c = 0; map_.body[node] == owner && c < 2; ++c) {
        total[c] += node_forces_[node][c];
        size[c] += std::abs(node_forces_[node][c]);
      }
    const double x = origin(number, 0, total, size), y = origin(number, 1, total, size);
    double sum = 0.0, terms = 0.0;
    for (std::size_t node = 0; node < map_.body.size(); ++node) {
      if (map_.body[node] != owner) continue;
      const element::MeshNode& at = map_.mesh.nodes[node];
      for (const double term : {node_forces_[node][0] * (at.x - x), node_forces_[node][1] * (at.y - y)}) {
        sum += term;
        terms += std::abs(term);
      }
    }
    return std::abs(sum) > rounding::many_operations * terms ? sum : 0.0;
  }

  const Scene& scene_;
  const DofMap& map_;
  const StaticForces& standing_;
  std::vector<Plane> node_forces_, uniform_;               // forces per node; forces per length, per element
  std::vector<double> supports_;                           // positions of moving supports
  std::vector<double> restoring_forces_;                   // per contact: restoring force of a pendulum
  Plane body_acceleration_{0.0, 0.0};                      // acceleration of gravity minus that of the base
  std::map<std::pair<bool, std::string>, double> values_;  // factors of loads and strains, by name
};

}  // namespace

Prestress prestress(const Scene& scene, const DofMap& map, const Model& model, const StaticForces& standing) {
  return PrestressAssembly(scene, map, model, standing).all();
}

void set_prestress(const Prestress& forces, const Scene& scene, DofMap& map) {
  const auto name = [&](int node) { return map.mesh.nodes[static_cast<std::size_t>(node)].name; };
  bool same =
      forces.elements.size() == map.mesh.elements.size() && forces.bodies.size() == scene.rigid.size();
  for (std::size_t i = 0; same && i < forces.elements.size(); ++i)
    same = forces.elements[i].from == name(map.mesh.element(i).nodes().front()) &&
           forces.elements[i].to == name(map.mesh.element(i).nodes().back());
  for (std::size_t i = 0; same && i < forces.bodies.size(); ++i)
    same = forces.bodies[i].name == scene.rigid[i].name;
  if (!same)
    throw SceneError(scene.initial.place, "run.initial.run",
                     "the prestress of the saved run (geometric.csv) belongs to other members or rigid "
                     "bodies: expected a run of the same structure");
  map.body_stiffness.clear();
  for (const Prestress::Body& body : forces.bodies) map.body_stiffness.push_back(body.stiffness);
  map.axial_forces.clear();
  for (const Prestress::Element& e : forces.elements) map.axial_forces.push_back({e.at_from, e.at_to});
}

}  // namespace signorini::assembly
