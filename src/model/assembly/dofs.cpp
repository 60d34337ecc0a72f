#include "model/assembly/dofs.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "model/assembly/moving_obstacles.hpp"
#include "model/assembly/ties.hpp"
#include "scene/components.hpp"

namespace signorini::assembly {
namespace {

using Numbers = std::vector<std::array<int, 3>>;

void need(Numbers& numbers, int node, const std::array<double, 2>& direction) {
  for (std::size_t c = 0; c < 2; ++c)
    if (direction[c] != 0.0) numbers[static_cast<std::size_t>(node)][c] = DofMap::needed;
}

void mark_needed_dofs(const Scene& scene, const element::Mesh& mesh, Numbers& numbers) {
  for (const auto& e : mesh.elements)
    for (const element::ElementUnknown& unknown : e->unknowns())
      if (!unknown.internal)
        numbers[static_cast<std::size_t>(e->nodes()[unknown.local_node])][unknown.component] = DofMap::needed;
  for (std::size_t i = 0; i < scene.masses.size(); ++i) {
    const PointMass& m = scene.masses[i];
    const int node = element::find_node(mesh, m.node, m.place,
                                        m.key.empty() ? fmt::format("masses.{}.node", i + 1) : m.key);
    if (m.mass > 0.0) need(numbers, node, {1.0, 1.0});
    if (m.inertia > 0.0) numbers[static_cast<std::size_t>(node)][2] = DofMap::needed;
  }
  for (const RigidBody& body : scene.rigid) {
    const std::string key = "rigid." + body.name + ".";
    numbers[static_cast<std::size_t>(element::find_node(mesh, body.centre, body.place, key + "centre"))].fill(
        DofMap::needed);
    for (const std::string& name : body.nodes)
      numbers[static_cast<std::size_t>(element::find_node(mesh, name, body.place, key + "nodes"))].fill(
          DofMap::needed);
  }
  for (std::size_t i = 0; i < scene.springs.size(); ++i) {
    const Spring& s = scene.springs[i];
    const auto d = clean_direction(s.direction);
    const bool pulls = s.stiffness != 0.0 || s.damping != 0.0;
    const bool turns = s.rotation_stiffness != 0.0 || s.rotation_damping != 0.0;
    const auto mark_spring_end = [&](int node) {
      if (pulls || !turns) need(numbers, node, d);
      if (turns) numbers[static_cast<std::size_t>(node)][2] = DofMap::needed;
    };
    mark_spring_end(element::find_node(mesh, s.node, s.place, fmt::format("springs.{}.node", i + 1)));
    if (!s.against.empty())
      mark_spring_end(element::find_node(mesh, s.against, s.place, fmt::format("springs.{}.against", i + 1)));
  }
  for (const ContactSpec& c : scene.contacts) {
    const auto mark_contact_nodes = [&](const Direction& at, const std::array<double, 2>& direction) {
      need(numbers, element::find_node(mesh, at.node, c.place, c.key("node")), direction);
      for (const auto& [node, weight] : at.against)
        if (weight != 0.0)
          need(numbers, element::find_node(mesh, node, c.place, c.key("against")), direction);
    };
    if (const Direction* n = c.bearing_normal()) mark_contact_nodes(*n, clean_direction(n->vector));
    // A contact without friction takes no tangential force, so it needs no tangential motion either.
    if (c.capabilities().normal_force_given || c.friction.any()) {
      const Direction* at = c.tangent ? &*c.tangent : c.normal ? &*c.normal : nullptr;
      if (at != nullptr && !at->node.empty()) mark_contact_nodes(*at, sliding_direction(c));
    }
  }
}

void add_columns(DofMap& map) {
  for (std::size_t node = 0; node < static_cast<std::size_t>(map.mesh.named); ++node) {
    if (!map.mesh.nodes[node].listed) continue;
    for (bool velocity : {false, true})
      for (int d : map.number[node])
        if (d >= 0) {
          const Dof& dof = map.is_tied(d) ? map.tied[static_cast<std::size_t>(d - map.size())].dof
                                          : map.dofs[static_cast<std::size_t>(d)];
          map.columns.push_back({velocity ? dof.velocity : dof.displacement, d, velocity});
        }
  }
}

/// Support i has a motion and fixes one component of its node: makes this component follow the motion.
void follow(DofMap& map, std::size_t i, const Support& s, const std::array<bool, 3>& fix) {
  const std::string key = s.key + ".motion";
  auto& moving = map.moving[static_cast<std::size_t>(element::find_node(map.mesh, s.node, s.place, key))];
  for (std::size_t c = 0; c < 3; ++c) {
    if (!fix[c]) continue;
    if (moving[c] >= 0)
      throw SceneError(
          s.place, key,
          fmt::format("another support already moves the {} of node '{}'; remove one of the two supports",
                      scene::plane_components[c].displacement, s.node));
    moving[c] = static_cast<int>(map.supports.size());
  }
  map.supports.push_back(i);
}

/// Errors: SceneError if one support fixes a component that another support moves.
void check_moving(const Scene& scene, const DofMap& map) {
  for (std::size_t i = 0; i < scene.supports.size(); ++i) {
    const Support& s = scene.supports[i];
    const auto& moving = map.moving[static_cast<std::size_t>(map.mesh.by_name.at(s.node))];
    const std::array<bool, 3> fix{s.ux, s.uy, s.rz};
    for (std::size_t c = 0; c < 3; ++c)
      if (fix[c] && !s.motion && moving[c] >= 0)
        throw SceneError(s.place, s.key + ".fix",
                         fmt::format("another support moves the {} of node '{}', so this support cannot fix "
                                     "it; remove the component from one of the two supports",
                                     scene::plane_components[c].displacement, s.node));
  }
}

/// Numbers the elements' internal unknowns, for example "A-B.A.rz", the rotation of a hinged end.
void add_own(DofMap& map) {
  for (const element::MeshPiece& piece : map.mesh.pieces) {
    const std::string& from = map.mesh.node(piece.from).name;
    const std::string& to = map.mesh.node(piece.to).name;
    for (std::size_t i = piece.first; i < piece.first + piece.count; ++i) {
      const element::FiniteElement& element = map.mesh.element(i);
      if (!element.has_internal_unknowns()) continue;
      const std::vector<element::ElementUnknown> unknowns = element.unknowns();
      for (std::size_t j = 0; j < unknowns.size(); ++j) {
        if (!unknowns[j].internal) continue;
        const int node = element.nodes()[unknowns[j].local_node];
        const std::size_t c = unknowns[j].component;
        map.internal[{i, j}] = map.size();
        map.locations.emplace_back(node, static_cast<int>(c));
        const std::string name = fmt::format("{}-{}.{}.", from, to, map.mesh.node(node).name);
        map.dofs.push_back({name + scene::plane_components[c].displacement,
                            name + scene::plane_components[c].velocity, scene::plane_components[c].rotation,
                            false});
      }
    }
  }
}

}  // namespace

std::array<double, 2> clean_direction(const std::array<double, 2>& v) {
  const double bound = rounding::few_operations * std::hypot(v[0], v[1]);
  return {std::abs(v[0]) > bound ? v[0] : 0.0, std::abs(v[1]) > bound ? v[1] : 0.0};
}

std::array<double, 2> tangent_of(const std::array<double, 2>& normal) { return {normal[1], -normal[0]}; }

std::array<double, 2> sliding_direction(const ContactSpec& contact) {
  if (contact.tangent) return clean_direction(contact.tangent->vector);
  if (contact.normal) return clean_direction(tangent_of(contact.normal->vector));
  return {0.0, 0.0};
}

void refuse_missing_rotation(const SourcePlace& place, const std::string& key, const std::string& node) {
  throw SceneError(place, key,
                   fmt::format("node '{}' has no rotation: the node has no inertia and no rotational spring, "
                               "and no beam is connected to it without a hinge",
                               node));
}

DofMap number_nodes(const Scene& scene) { return number_nodes(scene, element::make_mesh(scene)); }

DofMap number_nodes(const Scene& scene, element::Mesh mesh) {
  DofMap map;
  map.mesh = std::move(mesh);
  map.number.assign(map.mesh.nodes.size(), {DofMap::absent, DofMap::absent, DofMap::absent});
  map.moving = map.number;  // all absent
  mark_needed_dofs(scene, map.mesh, map.number);
  for (std::size_t i = 0; i < scene.supports.size(); ++i) {
    const Support& s = scene.supports[i];
    auto& numbers =
        map.number[static_cast<std::size_t>(element::find_node(map.mesh, s.node, s.place, s.key + ".node"))];
    const std::array<bool, 3> fix{s.ux, s.uy, s.rz};
    if (s.motion && s.rz && numbers[2] == DofMap::absent)
      refuse_missing_rotation(s.place, s.key + (s.motion_is_acceleration ? ".acceleration" : ".motion"),
                              s.node);
    for (std::size_t c = 0; c < 3; ++c)
      if (fix[c]) numbers[c] = DofMap::fixed;
    if (s.motion) follow(map, i, s, fix);
  }
  check_moving(scene, map);
  const std::vector<BodyMotion> bodies = find_bodies(scene, map);
  mark_slave_dofs(scene, map);
  for (std::size_t node = 0; node < map.number.size(); ++node)
    for (std::size_t c = 0; c < 3; ++c) {
      if (map.number[node][c] != DofMap::needed) continue;
      const std::string& name = map.mesh.nodes[node].name;
      map.number[node][c] = map.size();
      map.locations.emplace_back(static_cast<int>(node), static_cast<int>(c));
      map.dofs.push_back({name + "." + scene::plane_components[c].displacement,
                          name + "." + scene::plane_components[c].velocity,
                          scene::plane_components[c].rotation, false});
    }
  add_own(map);
  tie(bodies, map);
  follow_obstacles(scene, map);
  tie_seams(scene, map);
  add_columns(map);
  return map;
}

bool DofMap::within_body(const element::FiniteElement& e) const {
  return !e.has_internal_unknowns() && in_one_body(e.nodes());
}

bool DofMap::in_one_body(const std::vector<int>& nodes) const {
  const int owner = body[static_cast<std::size_t>(nodes.front())];
  return owner != absent && std::all_of(nodes.begin(), nodes.end(), [&](int node) {
           return body[static_cast<std::size_t>(node)] == owner;
         });
}

void DofMap::tie(int node, std::size_t c, std::vector<TiedTerm> terms) {
  number[static_cast<std::size_t>(node)][c] = size() + static_cast<int>(tied.size());
  const scene::PlaneComponent& component = scene::plane_components[c];
  const std::string name = mesh.node(node).name + ".";
  tied.push_back({{name + component.displacement, name + component.velocity, component.rotation, false},
                  std::move(terms)});
}

std::vector<TiedTerm> DofMap::terms(int n) const {
  if (is_tied(n)) return tied[static_cast<std::size_t>(n - size())].terms;
  if (n == absent || n == fixed) return {};
  return {{n, 1.0}};
}

void DofMap::add(Vector& form, int n, double factor) const {
  for (const TiedTerm& term : terms(n))
    if (term.number >= 0) form[term.number] += factor * term.factor;
}

double DofMap::value(const Vector& x, int n) const {
  double sum = 0.0;
  for (const TiedTerm& term : terms(n))
    if (term.number >= 0) sum += term.factor * x[term.number];
  return sum;
}

int DofMap::own_number(int node, std::size_t c) const {
  const int n = number[static_cast<std::size_t>(node)][c];
  if (!is_tied(n)) return n;
  for (const TiedTerm& term : tied[static_cast<std::size_t>(n - size())].terms)
    if (term.number >= 0 &&
        locations[static_cast<std::size_t>(term.number)] == std::pair(node, static_cast<int>(c)))
      return term.number;
  return absent;
}

std::array<int, 3> DofMap::numbers_at(int node) const {
  std::array<int, 3> numbers = number[static_cast<std::size_t>(node)];
  for (std::size_t c = 0; c < 3; ++c)
    if (const int i = moving[static_cast<std::size_t>(node)][c]; i >= 0) numbers[c] = support_code(i);
  return numbers;
}

std::vector<int> DofMap::element_numbers(std::size_t i) const {
  const element::FiniteElement& e = mesh.element(i);
  const std::vector<element::ElementUnknown> unknowns = e.unknowns();
  std::vector<int> numbers;
  numbers.reserve(unknowns.size());
  for (std::size_t j = 0; j < unknowns.size(); ++j)
    numbers.push_back(unknowns[j].internal
                          ? internal.at({i, j})
                          : numbers_at(e.nodes()[unknowns[j].local_node])[unknowns[j].component]);
  return numbers;
}

DofMap number_matrices(const MatricesSpec& matrices) {
  DofMap map;
  for (const std::string& name : matrices.dofs) {
    const int d = map.size();
    map.dofs.push_back({name + ".u", name + ".v", false, false});
    map.columns.push_back({name + ".u", d, false});
    map.columns.push_back({name + ".v", d, true});
  }
  return map;
}

Combination combination(const DofMap& map, const Direction& direction, const std::string& key, bool unit,
                        bool skip_absent) {
  Combination result;
  if (map.is_matrix_scene()) {
    for (const auto& [name, factor] : direction.dofs) {
      const std::string wanted = name + ".u";
      const auto it = std::find_if(map.dofs.begin(), map.dofs.end(),
                                   [&](const Dof& d) { return d.displacement == wanted; });
      if (it == map.dofs.end())
        throw SceneError(direction.place, key, fmt::format("no degree of freedom is named '{}'", name));
      if (factor != 0.0) result.terms.emplace_back(static_cast<int>(it - map.dofs.begin()), factor);
    }
    return result;
  }
  auto vector = clean_direction(direction.vector);
  const double length = std::hypot(vector[0], vector[1]);
  TiedForm form(map);
  const auto add = [&](const std::string& name, double weight) {
    const int node = element::find_node(map.mesh, name, direction.place, key);
    for (std::size_t c = 0; c < 2; ++c) {
      if (vector[c] == 0.0 || weight == 0.0) continue;
      const int d = map.numbers_at(node)[c];
      form.add(d, weight * (unit ? vector[c] / length : vector[c]));
      if (d == DofMap::absent && !skip_absent)
        throw SceneError(
            direction.place, key,
            fmt::format(
                "node '{}' has no degree of freedom in {}: no member, mass, spring or contact acts there",
                name, c == 0 ? "x" : "y"));
    }
  };
  add(direction.node, 1.0);
  for (const auto& [node, weight] : direction.against) add(node, -weight);
  // Motions of supports cancel in forms of contacts (moving_obstacles.hpp); the small rest of rounding is dropped.
  if (unit && form.follows_support())
    throw SceneError(
        direction.place, key,
        fmt::format("the motion of a support changes the gap or the slip of this contact at node '{}', "
                    "which must depend on degrees of freedom only; if all supports move together, give "
                    "[base_motion] instead of their motion",
                    direction.node));
  return form.combination();
}

SourcePlace place_of_structure(const Scene& scene) {
  if (scene.matrices) return scene.matrices->mass.place;
  if (!scene.members.empty()) return scene.members.front().place;
  if (!scene.bodies.empty()) return scene.bodies.front().place;
  return scene.nodes.empty() ? SourcePlace{scene.file, 1, 1} : scene.nodes.front().place;
}

SourcePlace place_of_dof(const Scene& scene, const DofMap& map, int dof) {
  if (map.is_matrix_scene()) return scene.matrices->stiffness.place;
  const int node = map.locations[static_cast<std::size_t>(dof)].first;
  const auto member_place = [&](std::size_t element) {
    const auto i = static_cast<std::size_t>(map.mesh.element(element).member());
    return i < scene.members.size() ? scene.members[i].place : scene.bodies[i - scene.members.size()].place;
  };
  for (const auto& [unknown, number] : map.internal)
    if (number == dof) return member_place(unknown.first);
  if (node < map.mesh.named) {
    const std::string& name = map.mesh.nodes[static_cast<std::size_t>(node)].name;
    const auto at = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                 [&](const Node& candidate) { return candidate.name == name; });
    return at == scene.nodes.end() ? place_of_structure(scene) : at->place;
  }
  for (std::size_t e = 0; e < map.mesh.elements.size(); ++e) {
    const std::vector<int>& nodes = map.mesh.element(e).nodes();
    if (std::find(nodes.begin(), nodes.end(), node) != nodes.end()) return member_place(e);
  }
  return place_of_structure(scene);
}

}  // namespace signorini::assembly
