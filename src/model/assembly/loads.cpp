#include "model/assembly/loads.hpp"

#include <fmt/core.h>

#include <cmath>

#include "scene/history_from_spec.hpp"
#include "scene/quantities.hpp"

namespace signorini {
namespace {

Combination form_of(const Vector& v, double factor) {
  Combination form;
  for (int i = 0; i < v.size(); ++i)
    if (v[i] != 0.0) form.terms.emplace_back(i, factor * v[i]);
  return form;
}

/// A constant without a start has held since ever.
bool holds_since_ever(const HistorySpec& spec, const History& history) {
  return spec.type == HistoryType::constant && history.is_constant();
}

Vector moment_form(const LoadSpec& spec, const DofMap& map, const std::string& key) {
  Vector form = Vector::Zero(map.size());
  const int node = find_node(map.mesh, spec.direction.node, spec.place, key + ".node");
  const int dof = map.number[static_cast<std::size_t>(node)][2];
  if (dof == DofMap::absent)
    throw SceneError(
        spec.direction.place, key + ".node",
        fmt::format("nothing turns with node '{}': no beam that is not hinged there, no inertia and no "
                    "spring of rotations",
                    spec.direction.node));
  if (dof >= 0) form[dof] = 1.0;
  return form;
}

/// The one piece of a member between two nodes, and whether it runs the other way.
std::pair<const MeshPiece*, bool> piece_between(const DofMap& map, const std::string& a, const std::string& b,
                                                const LoadSpec& spec, const std::string& key) {
  const int from = find_node(map.mesh, a, spec.place, key), to = find_node(map.mesh, b, spec.place, key);
  const MeshPiece* found = nullptr;
  for (const MeshPiece& piece : map.mesh.pieces) {
    const bool joins = (piece.from == from && piece.to == to) || (piece.from == to && piece.to == from);
    if (!joins) continue;
    if (found)
      throw SceneError(spec.place, key,
                       fmt::format("two members join nodes '{}' and '{}', expected one", a, b));
    found = &piece;
  }
  if (!found)
    throw SceneError(spec.place, key, fmt::format("no piece of a member joins nodes '{}' and '{}'", a, b));
  return {found, found->from != from};
}

/// Length of an element, cosine and sine of its direction.
struct Axis {
  double length, c, s;
};
Axis axis_of(const Mesh& mesh, const MeshElement& element) {
  const MeshNode& a = mesh.nodes[static_cast<std::size_t>(element.a)];
  const MeshNode& b = mesh.nodes[static_cast<std::size_t>(element.b)];
  const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
  return {length, dx / length, dy / length};
}

/// Adds what a force per length of one does to one element.
void add_uniform(const DofMap& map, std::size_t element, const LoadSpec& spec, bool backwards, Vector& form) {
  const MeshElement& e = map.mesh.elements[element];
  const auto [length, c, s] = axis_of(map.mesh, e);
  const double turn = backwards ? -1.0 : 1.0;
  auto q = spec.direction.vector;
  if (spec.member_axes) q = {turn * (q[0] * c - q[1] * s), turn * (q[0] * s + q[1] * c)};
  const double across = -q[0] * s + q[1] * c;
  const double moment = e.type == MemberType::bar ? 0.0 : across * length * length / 12.0;
  const std::array<double, 6> forces{0.5 * q[0] * length, 0.5 * q[1] * length, moment,
                                     0.5 * q[0] * length, 0.5 * q[1] * length, -moment};
  const std::array<int, 6> numbers = map.element_numbers(element);
  for (std::size_t i = 0; i < 6; ++i)
    if (numbers[i] >= 0) form[numbers[i]] += forces[i];
}

Vector distributed_form(const LoadSpec& spec, const DofMap& map, const std::string& key) {
  Vector form = Vector::Zero(map.size());
  for (std::size_t i = 0; i + 1 < spec.pieces.size(); ++i) {
    const auto [piece, backwards] =
        piece_between(map, spec.pieces[i], spec.pieces[i + 1], spec, key + ".nodes");
    for (std::size_t e = piece->first; e < piece->first + piece->count; ++e)
      add_uniform(map, e, spec, backwards, form);
  }
  return form;
}

/// Adds one of the three kinds of [[loads]].
Load given_load(const LoadSpec& spec, const DofMap& map, std::size_t number) {
  const std::string key = fmt::format("loads.{}", number);
  Load load;
  load.name = spec.name.empty() ? fmt::format("load {}", number) : spec.name;
  load.history = make_history(spec.history, key + ".history").scaled(spec.amplitude);
  load.is_static = holds_since_ever(spec.history, load.history);
  switch (spec.type) {
    case LoadType::force:
      load.direction = combination(map, spec.direction, key, false);
      break;
    case LoadType::moment:
      load.kind = LoadKind::moment;
      load.direction = form_of(moment_form(spec, map, key), 1.0);
      load.of_direction = {0, -1, 0};
      load.of_history = {1, 1, 0};
      break;
    case LoadType::distributed:
      load.kind = LoadKind::distributed;
      load.direction = form_of(distributed_form(spec, map, key), 1.0);
      load.of_direction = unit::length;
      load.of_history = unit::stiffness;
      break;
  }
  return load;
}

/// Forces at the ends of its elements that hold a unit strain of a member.
Combination strain_form(const Scene& scene, const DofMap& map, int member) {
  Vector form = Vector::Zero(map.size());
  for (std::size_t i = 0; i < map.mesh.elements.size(); ++i) {
    const MeshElement& e = map.mesh.elements[i];
    if (e.member != member) continue;
    const Axis axis = axis_of(map.mesh, e);
    const double force = scene.sections[static_cast<std::size_t>(e.section)].EA;
    const std::array<int, 6> numbers = map.element_numbers(i);
    const std::array<double, 2> along{force * axis.c, force * axis.s};
    for (std::size_t c = 0; c < 2; ++c) {
      if (numbers[c] >= 0) form[numbers[c]] -= along[c];
      if (numbers[c + 3] >= 0) form[numbers[c + 3]] += along[c];
    }
  }
  return form_of(form, 1.0);
}

void add_strains(const Scene& scene, const DofMap& map, std::vector<Load>& loads) {
  for (std::size_t i = 0; i < scene.members.size(); ++i) {
    const Member& member = scene.members[i];
    const auto add = [&](const char* what, const char* key, const HistorySpec& spec, double factor) {
      const History history = make_history(spec, fmt::format("members.{}.{}", i + 1, key)).scaled(factor);
      if (history.is_constant() && history.value(0.0) == 0.0) return;
      Load load{fmt::format("{} of member {}", what, i + 1), strain_form(scene, map, static_cast<int>(i)),
                history, holds_since_ever(spec, history)};
      load.kind = LoadKind::strain;
      load.of_direction = unit::force;
      load.of_history = unit::plain;
      loads.push_back(std::move(load));
    };
    add("temperature", "temperature", member.temperature, member.thermal_expansion);
    add("initial strain", "initial_strain", member.initial_strain, 1.0);
  }
}

void add_base(const Scene& scene, const Assembly& assembly, std::vector<Load>& loads) {
  const std::size_t count = scene.base_motion.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::string key = count == 1 ? "base_motion" : fmt::format("base_motion.{}", i + 1);
    const History acceleration = make_history(scene.base_motion[i].acceleration, key + ".acceleration");
    Load load{count == 1 ? "base motion" : fmt::format("base motion {}", i + 1),
              form_of(assembly.base[i], 1.0), acceleration.scaled(-1.0), false};
    load.kind = LoadKind::base;
    load.of_direction = unit::mass;
    load.of_history = unit::acceleration;
    if (!load.direction.terms.empty()) loads.push_back(std::move(load));
  }
}

/// Whether f jumps between 0 and t_end; the time, or -1.
double jump_of(const History& f, double t_end) {
  for (const Breakpoint& b : f.breakpoints())
    if (b.jump && b.time > 0.0 && b.time < t_end) return b.time;
  return -1.0;
}

}  // namespace

std::vector<Load> support_loads(const Scene& scene, const DofMap& map, const Assembly& assembly, double alpha,
                                double beta) {
  std::vector<Load> loads;
  for (std::size_t i = 0; i < map.supports.size(); ++i) {
    const std::size_t number = map.supports[i];
    const Support& support = scene.supports[number];
    const std::string key =
        fmt::format("supports.{}.{}", number + 1, support.motion_is_acceleration ? "acceleration" : "motion");
    History s = make_history(*support.motion, key);
    if (support.motion_is_acceleration) s = s.integrated().integrated();
    const SupportColumns& columns = assembly.moving[i];
    const bool moves_mass = !columns.mass.isZero(0.0);
    const bool damps = !columns.dampers.isZero(0.0) || beta != 0.0 || (alpha != 0.0 && moves_mass);
    if (const double t = jump_of(s, scene.run.t_end); t >= 0.0 && (moves_mass || damps))
      throw SceneError(
          support.place, key,
          fmt::format("the motion jumps at time {:.6g}, where mass or damping would answer with an "
                      "infinite force: give it time",
                      t));
    if (const double t = jump_of(s.with_rates(0.0, 1.0, 0.0), scene.run.t_end); t >= 0.0 && moves_mass)
      throw SceneError(
          support.place, key,
          fmt::format("the velocity jumps at time {:.6g}, where mass would answer with an impulse: "
                      "give a smooth motion (interpolation = \"steffen\"), or an acceleration; or mass "
                      "= \"lumped\" to the members there",
                      t));
    const char* component = support.ux ? "ux" : support.uy ? "uy" : "rz";
    const int length = support.rz ? 0 : 1;
    const auto add = [&](const char* what, const Vector& column, History f, int time) {
      Load load{fmt::format("support {}.{}{}", support.node, component, what), form_of(column, -1.0),
                std::move(f), time == 0};
      load.kind = LoadKind::support;
      load.of_direction = {1, -length, time};
      load.of_history = {0, length, -time};
      if (!load.direction.terms.empty()) loads.push_back(std::move(load));
    };
    add("", columns.stiffness, s.with_rates(1.0, beta, 0.0), 0);
    add(" (mass)", columns.mass, s.with_rates(0.0, alpha, 1.0), 2);
    add(" (dampers)", columns.dampers, s.with_rates(0.0, 1.0, 0.0), 1);
  }
  return loads;
}

std::vector<Load> make_loads(const Scene& scene, const DofMap& map, const Assembly& assembly) {
  std::vector<Load> loads;
  Load gravity{"gravity", form_of(assembly.weight, 1.0), History::constant(1.0), true};
  gravity.kind = LoadKind::weight;
  gravity.of_direction = unit::force;
  gravity.of_history = unit::plain;
  if (!gravity.direction.terms.empty()) loads.push_back(std::move(gravity));
  for (std::size_t i = 0; i < scene.loads.size(); ++i)
    loads.push_back(given_load(scene.loads[i], map, i + 1));
  add_strains(scene, map, loads);
  add_base(scene, assembly, loads);
  for (Load& load : support_loads(scene, map, assembly, 0.0, 0.0)) loads.push_back(std::move(load));
  return loads;
}

Vector static_load(const std::vector<Load>& loads, int n) {
  Vector p = Vector::Zero(n);
  for (const Load& load : loads)
    if (load.is_static) load.direction.add_to(p, load.history.value(0.0));
  return p;
}

}  // namespace signorini
