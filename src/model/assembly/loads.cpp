#include "model/assembly/loads.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/rounding.hpp"
#include "mesh/shape_functions.hpp"
#include "model/assembly/member_pieces.hpp"
#include "scene/components.hpp"
#include "scene/history_from_spec.hpp"
#include "scene/quantities.hpp"
#include "scene/saved_state.hpp"

namespace signorini::assembly {
namespace {

Combination form_of(const Vector& v, double factor) {
  Combination form;
  for (int i = 0; i < v.size(); ++i)
    if (v[i] != 0.0) form.terms.emplace_back(i, factor * v[i]);
  return form;
}

/// True for a constant history without `start`: such a load has always acted.
bool acts_from_the_beginning(const HistorySpec& spec, const History& history) {
  return spec.type == HistoryType::constant && history.is_constant();
}

Vector moment_form(const LoadSpec& spec, const DofMap& map, const std::string& key) {
  Vector form = Vector::Zero(map.size());
  const int node = element::find_node(map.mesh, spec.direction.node, spec.place, key + ".node");
  const int dof = map.number[static_cast<std::size_t>(node)][2];
  if (dof == DofMap::absent)
    refuse_missing_rotation(spec.direction.place, key + ".node", spec.direction.node);
  map.add(form, dof, 1.0);
  return form;
}

/// Adds forces on the unknowns of an element to the form.
void add_to(Vector& form, const element::ElementVector& forces, const DofMap& map, std::size_t element) {
  const std::vector<int> numbers = map.element_numbers(element);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    map.add(form, numbers[i], forces[static_cast<Eigen::Index>(i)]);
}

/// Adds the nodal forces of a unit force per length on one element.
void add_uniform(const DofMap& map, std::size_t element, const LoadSpec& spec, bool backwards, Vector& form) {
  const element::LineElement& e = map.mesh.line(element);
  add_to(form, e.load_vector(along_line(spec, e.axis(), backwards)), map, element);
}

Vector distributed_form(const LoadSpec& spec, const DofMap& map, const std::string& key) {
  Vector form = Vector::Zero(map.size());
  for (std::size_t i = 0; i + 1 < spec.pieces.size(); ++i) {
    const auto [piece, backwards] =
        piece_between(map, spec.pieces[i], spec.pieces[i + 1], spec.place, key + ".nodes");
    for (std::size_t e = piece->first; e < piece->first + piece->count; ++e)
      add_uniform(map, e, spec, backwards, form);
  }
  return form;
}

Vector traction_form(const Scene& scene, const LoadSpec& spec, const DofMap& map) {
  Vector form = Vector::Zero(map.size());
  for (const NodeForce& f : traction_forces(scene, map.mesh, spec))
    for (std::size_t c = 0; c < 2; ++c) map.add(form, map.numbers_at(f.node)[c], f.force[c]);
  return form;
}

/// Returns the history. Errors: SceneError if the product of its finite factors has overflowed.
History finite(History history, const SourcePlace& place, const std::string& key) {
  for (const Piece& p : history.pieces()) {
    bool all = std::isfinite(p.amplitude);
    for (const double c : p.coefficients) all = all && std::isfinite(c);
    if (!all) throw SceneError(place, key, "found factors whose product overflows, expected a finite load");
  }
  return history;
}

/// Converts an entry of [[loads]] to a form and a history. number: position in [[loads]], from 1.
Load make_load(const Scene& scene, const LoadSpec& spec, const DofMap& map, std::size_t number) {
  const std::string key = fmt::format("loads.{}", number);
  Load load;
  load.name = name_of(spec, number);
  load.history = finite(scene::make_history(spec.history, key + ".history").scaled(spec.amplitude),
                        spec.place, key + ".amplitude");
  load.is_static = acts_from_the_beginning(spec.history, load.history);
  load.history_unit = unit_of_history(spec.type);
  switch (spec.type) {
    case LoadType::force:
      load.direction = combination(map, spec.direction, key, false);
      break;
    case LoadType::moment:
      load.kind = LoadKind::moment;
      load.direction = form_of(moment_form(spec, map, key), 1.0);
      load.direction_unit = {0, -1, 0};
      break;
    case LoadType::distributed:
      load.kind = LoadKind::distributed;
      load.direction = form_of(distributed_form(spec, map, key), 1.0);
      load.direction_unit = unit::length;
      break;
    case LoadType::traction:
      load.kind = LoadKind::distributed;
      load.direction = form_of(traction_form(scene, spec, map), 1.0);
      load.direction_unit = {0, 2, 0};
      break;
  }
  return load;
}

/// Relative rounding error of an element's direction (a difference of coordinates), in multiples of eps.
double coordinate_roundoff(const DofMap& map, const element::FiniteElement& e) {
  double reach = 0.0, least = std::numeric_limits<double>::infinity();
  for (const int i : e.nodes()) {
    const element::MeshNode& a = map.mesh.nodes[static_cast<std::size_t>(i)];
    reach = std::max(reach, std::hypot(a.x, a.y));
    for (const int j : e.nodes()) {
      const element::MeshNode& b = map.mesh.nodes[static_cast<std::size_t>(j)];
      if (i < j) least = std::min(least, std::hypot(a.x - b.x, a.y - b.y));
    }
  }
  return reach / least;
}

/// Forces at the ends of the elements that balance a unit strain of a member. At inner nodes of a straight line these
/// forces cancel up to rounding; the remainder is set to zero, since it would move a string across its axis.
Combination strain_form(const DofMap& map, int member) {
  Vector form = Vector::Zero(map.size()), size = form;
  for (std::size_t i = 0; i < map.mesh.elements.size(); ++i) {
    const element::FiniteElement& e = map.mesh.element(i);
    if (e.member() != member || map.within_body(e)) continue;
    const element::ElementVector forces = e.strain_forces();
    const double known = 1.0 + coordinate_roundoff(map, e);
    add_to(form, forces, map, i);
    const std::vector<int> numbers = map.element_numbers(i);
    for (std::size_t j = 0; j < numbers.size(); ++j)
      for (const TiedTerm& term : map.terms(numbers[j]))
        if (term.number >= 0)
          size[term.number] += known * std::abs(term.factor * forces[static_cast<Eigen::Index>(j)]);
  }
  return form_of((form.array().abs() > rounding::many_operations * size.array()).select(form, 0.0), 1.0);
}

void add_body_temperatures(const Scene& scene, const DofMap& map, std::vector<Load>& loads) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const BodySpec& body = scene.bodies[i];
    const std::string path = fmt::format("bodies.{}.temperature", body.name);
    const History history =
        finite(scene::make_history(body.temperature, path).scaled(body.thermal_expansion), body.place, path);
    if (history.is_constant() && history.value(0.0) == 0.0) continue;
    const auto owner = static_cast<int>(scene.members.size() + i);
    Load load{fmt::format("temperature of body {}", body.name), strain_form(map, owner), history,
              acts_from_the_beginning(body.temperature, history)};
    load.kind = LoadKind::temperature;
    load.direction_unit = unit::force;
    load.history_unit = unit::plain;
    loads.push_back(std::move(load));
  }
}

void add_member_strains(const Scene& scene, const DofMap& map, std::vector<Load>& loads) {
  for (std::size_t i = 0; i < scene.members.size(); ++i) {
    const Member& member = scene.members[i];
    const auto add = [&](LoadKind kind, const char* key, const HistorySpec& spec, double factor) {
      const std::string path = fmt::format("members.{}.{}", i + 1, key);
      const History history = finite(scene::make_history(spec, path).scaled(factor), member.place, path);
      if (history.is_constant() && history.value(0.0) == 0.0) return;
      Load load{name_of_strain(kind, static_cast<int>(i)), strain_form(map, static_cast<int>(i)), history,
                acts_from_the_beginning(spec, history)};
      load.kind = kind;
      load.direction_unit = unit::force;
      load.history_unit = unit::plain;
      loads.push_back(std::move(load));
    };
    add(LoadKind::temperature, "temperature", member.temperature, member.thermal_expansion);
    add(LoadKind::initial_strain, "initial_strain", member.initial_strain, 1.0);
  }
}

/// Adds the loads from preloaded springs: a spring in tension pulls its node against the spring's direction.
void add_preloads(const Scene& scene, const DofMap& map, std::vector<Load>& loads) {
  for (std::size_t i = 0; i < scene.springs.size(); ++i) {
    const Spring& spring = scene.springs[i];
    if (spring.preload == 0.0) continue;
    const auto d = clean_direction(spring.direction);
    const double length = std::hypot(d[0], d[1]);
    Direction pull{spring.node, {-d[0] / length, -d[1] / length}, {}, spring.place, {}};
    if (!spring.against.empty()) pull.against.emplace_back(spring.against, 1.0);
    Load load{name_of_preload(i), combination(map, pull, fmt::format("springs.{}", i + 1), false),
              History::constant(spring.preload), true};
    load.kind = LoadKind::preload;
    loads.push_back(std::move(load));
  }
}

void add_base(const Scene& scene, const Assembly& assembly, std::vector<Load>& loads) {
  const std::size_t count = scene.base_motion.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::string key = count == 1 ? "base_motion" : fmt::format("base_motion.{}", i + 1);
    const History acceleration =
        scene::make_history(scene.base_motion[i].acceleration, key + ".acceleration");
    Load load{count == 1 ? "base motion" : fmt::format("base motion {}", i + 1),
              form_of(assembly.base[i], 1.0), acceleration.scaled(-1.0), false};
    load.kind = LoadKind::base;
    load.direction_unit = unit::mass;
    load.history_unit = unit::acceleration;
    if (!load.direction.terms.empty() || scene.run.geometric) loads.push_back(std::move(load));
  }
}

/// Time of the first jump of f between 0 and t_end; -1 if f has none.
double first_jump_time(const History& f, double t_end) {
  for (const Breakpoint& b : f.breakpoints())
    if (b.jump && b.time > 0.0 && b.time < t_end) return b.time;
  return -1.0;
}

/// Position of the support at the end of the saved run that the scene continues; 0 if the scene continues no run.
double saved_support_position(const Scene& scene, const std::string& name) {
  return scene.initial.saved ? scene::saved_motion(*scene.initial.saved, name).value_or(0.0) : 0.0;
}

/// Motion s(t) of a moving support, with its name.
struct SupportMotion {
  std::string name, key;
  SourcePlace place;
  bool turns = false;
  History s;
};
SupportMotion support_motion(const Scene& scene, const Support& support) {
  const scene::PlaneComponent& component = scene::plane_components[support.ux ? 0 : support.uy ? 1 : 2];
  SupportMotion moving{fmt::format("support {}.{}", support.node, component.displacement),
                       support.key + (support.motion_is_acceleration ? ".acceleration" : ".motion"),
                       support.place,
                       component.rotation,
                       {}};
  if (support.motion_is_acceleration) {
    const double s = saved_support_position(scene, moving.name),
                 rate = saved_support_position(scene, rate_of(moving.name));
    moving.s =
        scene::make_integral(*support.motion, moving.key).scaled(1.0, rate).integrated().scaled(1.0, s);
  } else {
    moving.s = scene::make_history(*support.motion, moving.key);
  }
  return moving;
}

/// Adds the load -column f, where f is the support's motion (order 0), velocity (1) or acceleration (2).
void add_support_load(const SupportMotion& moving, const char* what, const Vector& column, History f,
                      int order, std::vector<Load>& loads) {
  const int length = moving.turns ? 0 : 1;
  Load load{moving.name + what, form_of(column, -1.0), std::move(f), order == 0};
  load.kind = order == 0 ? LoadKind::support : LoadKind::support_rate;
  load.direction_unit = {1, -length, order};
  load.history_unit = {0, length, -order};
  if (!load.direction.terms.empty()) loads.push_back(std::move(load));
}

void add_supports(const Scene& scene, const DofMap& map, const Assembly& assembly, std::vector<Load>& loads) {
  for (std::size_t i = 0; i < map.supports.size(); ++i) {
    const SupportMotion moving = support_motion(scene, scene.supports[map.supports[i]]);
    add_support_load(moving, "", assembly.moving[i].stiffness, moving.s, 0, loads);
  }
}

}  // namespace

History motion_of_support(const Scene& scene, const DofMap& map, int i) {
  return motion_of_support(scene, scene.supports[map.supports[static_cast<std::size_t>(i)]]);
}

History motion_of_support(const Scene& scene, const Support& support) {
  return support_motion(scene, support).s;
}

std::vector<NodeForce> traction_forces(const Scene& scene, const element::Mesh& mesh, const LoadSpec& spec) {
  std::vector<NodeForce> forces;
  for (const BodySpec& body : scene.bodies)
    for (const PlaneMesh::Group& group : body.mesh.groups) {
      if (body.name + "." + group.name != spec.group) continue;
      for (const PlaneMesh::Edge& edge : group.edges) {
        std::vector<NodeForce> own;
        for (const int n : edge.nodes) own.push_back({n, {0.0, 0.0}});
        for (const mesh::EdgePoint& point : mesh::edge_points()) {
          const mesh::EdgeValues v = mesh::edge_shape_functions(edge.nodes.size(), point.s);
          double dx = 0.0, dy = 0.0;
          for (std::size_t i = 0; i < own.size(); ++i) {
            dx += v.derivatives[i] * mesh.node(own[i].node).x;
            dy += v.derivatives[i] * mesh.node(own[i].node).y;
          }
          const double ds = std::hypot(dx, dy);
          const std::array<double, 2> q =  // the unit normal into the body is (-dy, dx) / ds
              spec.pressure ? std::array{-dy, dx}
                            : std::array{ds * spec.direction.vector[0], ds * spec.direction.vector[1]};
          for (std::size_t i = 0; i < own.size(); ++i)
            for (std::size_t c = 0; c < 2; ++c)
              own[i].force[c] += body.thickness * point.weight * v.values[i] * q[c];
        }
        forces.insert(forces.end(), own.begin(), own.end());
      }
    }
  return forces;
}

std::string rate_of(const std::string& support_motion) {
  const std::string_view component = scene::last_part(support_motion);
  return support_motion.substr(0, support_motion.size() - component.size()) +
         scene::component_named(component).value().component().velocity;
}

std::string name_of(const LoadSpec& load, std::size_t number) {
  return load.name.empty() ? fmt::format("load {}", number) : load.name;
}

std::string name_of_preload(std::size_t spring) { return fmt::format("preload of spring {}", spring + 1); }

std::string name_of_strain(LoadKind kind, int member) {
  return fmt::format("{} of member {}", kind == LoadKind::temperature ? "temperature" : "initial strain",
                     member + 1);
}

Unit unit_of_history(LoadType type) {
  return type == LoadType::moment        ? unit::energy
         : type == LoadType::distributed ? unit::stiffness
         : type == LoadType::traction    ? Unit{1, -2, 0}
                                         : unit::force;
}

std::vector<Load> make_loads(const Scene& scene, const DofMap& map, const Assembly& assembly) {
  std::vector<Load> loads;
  Load gravity{"gravity", form_of(assembly.weight, 1.0), History::constant(1.0), true};
  gravity.kind = LoadKind::weight;
  gravity.direction_unit = unit::force;
  gravity.history_unit = unit::plain;
  // Gravity on fixed degrees of freedom alone still contributes to the geometric stiffness.
  const bool stiffens = scene.run.geometric && (scene.gravity[0] != 0.0 || scene.gravity[1] != 0.0);
  if (!gravity.direction.terms.empty() || stiffens) loads.push_back(std::move(gravity));
  for (std::size_t i = 0; i < scene.loads.size(); ++i)
    loads.push_back(make_load(scene, scene.loads[i], map, i + 1));
  add_member_strains(scene, map, loads);
  add_body_temperatures(scene, map, loads);
  add_preloads(scene, map, loads);
  add_base(scene, assembly, loads);
  add_supports(scene, map, assembly, loads);
  return loads;
}

void add_geometric_supports(const Scene& scene, const DofMap& map, const std::vector<Vector>& columns,
                            std::vector<Load>& loads) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].isZero(0.0)) continue;
    const SupportMotion moving = support_motion(scene, scene.supports[map.supports[i]]);
    const auto known = std::find_if(loads.begin(), loads.end(), [&](const Load& load) {
      return load.kind == LoadKind::support && load.name == moving.name;
    });
    if (known == loads.end()) {
      add_support_load(moving, "", columns[i], moving.s, 0, loads);
      continue;
    }
    Vector whole = -columns[i];
    known->direction.add_to(whole, 1.0);
    known->direction = form_of(whole, 1.0);
  }
}

void add_support_rates(const Scene& scene, const DofMap& map, const Assembly& assembly, double alpha,
                       double beta, std::vector<Load>& loads) {
  for (std::size_t i = 0; i < map.supports.size(); ++i) {
    const SupportMotion moving = support_motion(scene, scene.supports[map.supports[i]]);
    const SupportColumns& columns = assembly.moving[i];
    const Vector damping = columns.dampers + alpha * columns.mass + beta * columns.stiffness;
    const bool moves_mass = !columns.mass.isZero(0.0);
    const History velocity = moving.s.with_rates(0.0, 1.0, 0.0);
    if (const double t = first_jump_time(moving.s, scene.run.t_end);
        t >= 0.0 && (moves_mass || !damping.isZero(0.0)))
      throw SceneError(moving.place, moving.key,
                       fmt::format("the support motion jumps at t = {:.6g}; mass or damping would need an "
                                   "infinite force: replace the jump by a ramp",
                                   t));
    if (const double t = first_jump_time(velocity, scene.run.t_end); t >= 0.0 && moves_mass)
      throw SceneError(moving.place, moving.key,
                       fmt::format("the support velocity jumps at t = {:.6g}, so mass would need an impulse: "
                                   "give a smooth motion (interpolation = \"steffen\") or an acceleration, "
                                   "or set mass = \"lumped\" on the members at this support",
                                   t));
    add_support_load(moving, " (mass)", columns.mass, moving.s.with_rates(0.0, 0.0, 1.0), 2, loads);
    add_support_load(moving, " (damping)", damping, velocity, 1, loads);
  }
}

Vector static_load(const std::vector<Load>& loads, int n) {
  Vector p = Vector::Zero(n), size = p;
  for (const Load& load : loads) {
    if (!load.is_static) continue;
    const double value = load.history.value(0.0);
    load.direction.add_to(p, value);
    for (const auto& [dof, factor] : load.direction.terms) size[dof] += std::abs(factor * value);
  }
  // Sums of loads that are zero up to rounding are set to zero.
  return (p.array().abs() > rounding::many_operations * size.array()).select(p, 0.0);
}

}  // namespace signorini::assembly
