#include "model/outputs/structure_rows.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "model/assembly/loads.hpp"
#include "model/element/element_kinds.hpp"
#include "model/element/nodal_stress.hpp"
#include "scene/history_from_spec.hpp"
#include "scene/quantities.hpp"

namespace signorini::outputs {
namespace {

void add_given(PhysicalRow& row, const History& history, double factor) {
  if (factor == 0.0) return;
  History term = history.scaled(factor);
  if (term.is_constant())
    row.constant += term.value(0.0);
  else
    row.given.push_back({std::move(term)});
}

std::array<double, 2> unit_vector(const std::array<double, 2>& v) {
  const auto clean = assembly::clean_direction(v);
  const double length = std::hypot(clean[0], clean[1]);
  return {clean[0] / length, clean[1] / length};
}

}  // namespace

StructureRows::StructureRows(const Scene& scene, const assembly::DofMap& map, double alpha, double beta)
    : scene_(scene), map_(map), alpha_(alpha), beta_(beta), uniform_(map.mesh.elements.size()) {
  for (std::size_t i = 0; i < map.supports.size(); ++i)
    moving_.push_back(assembly::motion_of_support(scene, map, static_cast<int>(i)));
  for (const BaseMotionSpec& motion : scene.base_motion)
    base_.push_back(scene::make_history(motion.acceleration, "base_motion.acceleration"));
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    const LoadSpec& load = scene.loads[i];
    const std::string key = fmt::format("loads.{}", i + 1);
    loads_.push_back({scene::make_history(load.history, key + ".history").scaled(load.amplitude),
                      assembly::name_of(load, i + 1), 1.0, assembly::unit_of_history(load.type)});
    tractions_.emplace_back();
    if (load.type == LoadType::traction) tractions_.back() = assembly::traction_forces(scene, map.mesh, load);
    for (std::size_t j = 0; j + 1 < load.pieces.size(); ++j) {
      const auto [piece, backwards] =
          assembly::piece_between(map, load.pieces[j], load.pieces[j + 1], load.place, key + ".nodes");
      for (std::size_t e = piece->first; e < piece->first + piece->count; ++e)
        uniform_[e].push_back({i, assembly::along_line(load, map.mesh.line(e).axis(), backwards)});
    }
  }
  for (std::size_t i = 0; i < scene.members.size(); ++i) {
    const Member& member = scene.members[i];
    const std::string key = fmt::format("members.{}.", i + 1);
    strains_.push_back(
        {scene::make_history(member.temperature, key + "temperature").scaled(member.thermal_expansion),
         scene::make_history(member.initial_strain, key + "initial_strain")});
  }
  for (const BodySpec& body : scene.bodies)
    strains_.push_back({scene::make_history(body.temperature, fmt::format("bodies.{}.temperature", body.name))
                            .scaled(body.thermal_expansion)});
}

void StructureRows::add_motion(PhysicalRow& row, int number, double cu, double cv, double ca,
                               double rayleigh) const {
  if (map_.is_tied(number)) {
    for (const assembly::TiedTerm& term : map_.terms(number))
      add_motion(row, term.number, term.factor * cu, term.factor * cv, term.factor * ca,
                 term.factor * rayleigh);
  } else if (number >= 0) {
    row.u[number] += cu;
    row.v[number] += cv + rayleigh;
    row.a[number] += ca;
    row.rayleigh[number] += rayleigh;
  } else if (const int s = assembly::DofMap::support_of_code(number);
             s >= 0 && (cu != 0.0 || cv + rayleigh != 0.0 || ca != 0.0)) {
    add_given(row, moving_[static_cast<std::size_t>(s)].with_rates(cu, cv + rayleigh, ca), 1.0);
  }
}

void StructureRows::add_base_acceleration(PhysicalRow& row, double x, double y, bool gravity) const {
  if (gravity) row.constant -= x * scene_.gravity[0] + y * scene_.gravity[1];
  for (std::size_t i = 0; i < base_.size(); ++i) {
    const auto& r = scene_.base_motion[i].direction.vector;
    add_given(row, base_[i], x * r[0] + y * r[1]);
  }
}

void StructureRows::add_end_forces(PhysicalRow& row, std::size_t i, const element::SectionForce& cut,
                                   bool stiff) const {
  const element::FiniteElement& e = element(i);
  const auto moved = map_.mesh.moved.find(i);
  element::ElementVector ca = cut.acceleration;
  if (moved == map_.mesh.moved.end()) ca += e.mass() * cut.forces;
  element::ElementVector cu = element::ElementVector::Zero(ca.size()),
                         frozen = cut.deflection;  // terms of the prestress, which are not damped
  if (stiff) cu = e.stiffness() * cut.forces;
  const element::AxialForces standing = map_.axial_forces_in(i);
  if (stiff && !standing.is_zero() && !map_.within_body(e))
    frozen += e.geometric_stiffness(standing) * cut.forces;
  const std::vector<int> numbers = map_.element_numbers(i);
  const std::vector<element::ElementUnknown> unknowns = e.unknowns();
  element::PlaneVector frame{0.0, 0.0};
  for (std::size_t j = 0; j < numbers.size(); ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    add_motion(row, numbers[j], cu[at] + frozen[at], 0.0, ca[at], beta_ * cu[at] + alpha_ * ca[at]);
    if (unknowns[j].component < 2) frame[unknowns[j].component] += ca[at];
  }
  add_base_acceleration(row, frame[0], frame[1]);
  for (const Uniform& load : uniform_[i]) {
    const element::ElementVector f = e.load_vector(load.q);
    double factor = cut.load[0] * load.q[0] + cut.load[1] * load.q[1];
    for (Eigen::Index j = 0; j < f.size(); ++j) factor -= cut.forces[j] * f[j];
    add_load(row, load.load, factor);
  }
  if (!stiff) return;
  for (const History& strain : strains_[static_cast<std::size_t>(e.member())])
    add_given(row, strain, -e.strain_work(cut.forces));
}

/// Adds factor times the inertia force of an element's moved mass on component c of a node; node = -1: all nodes.
void StructureRows::add_moved_mass(PhysicalRow& row, std::size_t i, int node, std::size_t c,
                                   double factor) const {
  const element::MovedMass& moved = map_.mesh.moved.at(i);
  element::ElementVector along = element::ElementVector::Zero(moved.weights.cols());
  for (std::size_t j = 0; j < moved.nodes.size(); ++j)
    if (node < 0 || moved.nodes[j] == node) along[static_cast<Eigen::Index>(2 * j + c)] = factor;
  const element::ElementVector ca = moved.weights.transpose() * (element(i).mass() * (moved.weights * along));
  element::PlaneVector frame{0.0, 0.0};
  for (std::size_t j = 0; j < moved.nodes.size(); ++j)
    for (std::size_t d = 0; d < 2; ++d) {
      const double a = ca[static_cast<Eigen::Index>(2 * j + d)];
      add_motion(row, map_.numbers_at(moved.nodes[j])[d], 0.0, 0.0, a, alpha_ * a);
      frame[d] += a;
    }
  add_base_acceleration(row, frame[0], frame[1]);
}

void StructureRows::add_section_force(PhysicalRow& row, std::size_t i,
                                      const element::SectionForce& cut) const {
  add_end_forces(row, i, cut, true);
}

void StructureRows::add_stress(PhysicalRow& row, std::size_t body, int node,
                               const Eigen::RowVector3d& factors) const {
  for (const element::StressTerm& term : element::stress_at_node(map_.mesh, scene_, body, node)) {
    const Eigen::RowVector2d by_node = factors * term.rows;
    const auto numbers = map_.numbers_at(term.node);
    for (const std::size_t c : {std::size_t(0), std::size_t(1)}) {
      const double cu = by_node[static_cast<Eigen::Index>(c)];
      add_motion(row, numbers[c], cu, 0.0, 0.0, beta_ * cu);
    }
  }
  for (const History& strain : strains_[scene_.members.size() + body])
    add_given(row, strain, factors.dot(element::thermal_stress(scene_.bodies[body])));
}

std::array<double, 3> StructureRows::direction_of(const Spring& spring) const {
  const auto d = unit_vector(spring.direction);
  return {d[0], d[1], 1.0};
}

void StructureRows::add_spring(PhysicalRow& row, const Spring& spring, bool rotation, double factor) const {
  const double stiffness = factor * (rotation ? spring.rotation_stiffness : spring.stiffness);
  const double damping = factor * (rotation ? spring.rotation_damping : spring.damping);
  const double beta = spring.restoring ? 0.0 : beta_;
  const std::array<double, 3> d = direction_of(spring);
  const auto add = [&](const std::string& name, double sign) {
    const auto numbers = map_.numbers_at(map_.mesh.by_name.at(name));
    for (const std::size_t c : rotation ? std::vector<std::size_t>{2} : std::vector<std::size_t>{0, 1})
      if (d[c] != 0.0)
        add_motion(row, numbers[c], sign * stiffness * d[c], sign * damping * d[c], 0.0,
                   sign * beta * stiffness * d[c]);
  };
  if (!rotation && spring.preload != 0.0) row.constant += factor * spring.preload;
  add(spring.node, 1.0);
  if (!spring.against.empty()) add(spring.against, -1.0);
}

void StructureRows::add_mass(PhysicalRow& row, const PointMass& mass, std::size_t c, double factor) const {
  const double m = factor * (c == 2 ? mass.inertia : mass.mass);
  if (m == 0.0) return;
  add_motion(row, map_.numbers_at(map_.mesh.by_name.at(mass.node))[c], 0.0, 0.0, m, alpha_ * m);
  if (c != 2) add_base_acceleration(row, c == 0 ? m : 0.0, c == 1 ? m : 0.0);
}

/// Adds factor times load i. Even constant loads are not added to row.constant, because Steering may change them during a run.
void StructureRows::add_load(PhysicalRow& row, std::size_t i, double factor) const {
  if (factor == 0.0) return;
  const auto known = std::find_if(row.given.begin(), row.given.end(),
                                  [&](const Output::Given& g) { return g.load == loads_[i].load; });
  const bool first = known == row.given.end();
  Output::Given& given = first ? row.given.emplace_back(loads_[i]) : *known;
  given.factor = first ? factor : given.factor + factor;
  given.history = loads_[i].history.scaled(given.factor);
}

/// Adds factor times the force or moment of load i on component c of a node; node = -1: sum over all nodes.
void StructureRows::add_force(PhysicalRow& row, std::size_t i, int node, std::size_t c, double factor) const {
  const LoadSpec& load = scene_.loads[i];
  if (load.type == LoadType::distributed) return;
  if (load.type == LoadType::traction) {
    double force = 0.0;
    for (const assembly::NodeForce& f : tractions_[i])
      if (c < 2 && (node < 0 || f.node == node)) force += f.force[c];
    return add_load(row, i, factor * force);
  }
  if (node >= 0 && map_.mesh.by_name.at(load.direction.node) != node) return;
  const bool moment = load.type == LoadType::moment;
  if (moment != (c == 2)) return;
  add_load(row, i, factor * (moment ? 1.0 : load.direction.vector[c]));
}

/// Adds N n + T t of a contact on a node; node = -1: the sum over all nodes on which the contact acts.
void StructureRows::add_contact(PhysicalRow& row, std::size_t k, int node, std::size_t c,
                                double factor) const {
  const ContactSpec& spec = scene_.contacts[k];
  const Direction* at = spec.normal ? &*spec.normal : spec.tangent ? &*spec.tangent : nullptr;
  if (c == 2 || at == nullptr) return;
  double share = 0.0;
  const auto touches = [&](const std::string& name, double weight) {
    if (node < 0 || map_.mesh.by_name.at(name) == node) share += weight;
  };
  touches(at->node, 1.0);
  for (const auto& [name, weight] : at->against) touches(name, -weight);
  if (share == 0.0) return;
  Output::ContactForces forces{k};
  if (const Direction* n = spec.bearing_normal()) forces.N = factor * share * unit_vector(n->vector)[c];
  if (const auto t = assembly::sliding_direction(spec); t[0] != 0.0 || t[1] != 0.0)
    forces.T = factor * share * unit_vector(t)[c];
  if (forces.N != 0.0 || forces.T != 0.0) row.forces.push_back(forces);
  if (spec.pendulum_surface && forces.T != 0.0) row.curved_contacts.push_back({k, forces.T});
}

void StructureRows::add_reaction(PhysicalRow& row, int node, std::size_t c, double factor) const {
  for (std::size_t i = 0; i < map_.mesh.elements.size(); ++i) {
    const std::vector<int>& nodes = element(i).nodes();
    if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) continue;
    const std::vector<element::ElementUnknown> unknowns = element(i).unknowns();
    for (std::size_t j = 0; j < unknowns.size(); ++j) {
      // The rotation of a hinged end belongs to the element; it transmits no moment to the node.
      if (nodes[unknowns[j].local_node] != node || unknowns[j].component != c || unknowns[j].internal)
        continue;
      element::SectionForce cut(unknowns.size());
      cut.forces[static_cast<Eigen::Index>(j)] = factor;
      add_end_forces(row, i, cut, true);
    }
  }
  for (const auto& [i, moved] : map_.mesh.moved)
    if (c < 2 && std::find(moved.nodes.begin(), moved.nodes.end(), node) != moved.nodes.end())
      add_moved_mass(row, i, node, c, factor);
  for (const Spring& spring : scene_.springs) {
    const double d = direction_of(spring)[c];
    if (map_.mesh.by_name.at(spring.node) == node) add_spring(row, spring, c == 2, factor * d);
    if (!spring.against.empty() && map_.mesh.by_name.at(spring.against) == node)
      add_spring(row, spring, c == 2, -factor * d);
  }
  for (const PointMass& mass : scene_.masses)
    if (map_.mesh.by_name.at(mass.node) == node) add_mass(row, mass, c, factor);
  for (std::size_t i = 0; i < scene_.loads.size(); ++i) add_force(row, i, node, c, -factor);
  for (std::size_t k = 0; k < scene_.contacts.size(); ++k) add_contact(row, k, node, c, factor);
}

void StructureRows::add_total(PhysicalRow& row, std::size_t c) const {
  for (std::size_t i = 0; i < map_.mesh.elements.size(); ++i) {
    const element::PlaneVector along{c == 0 ? -1.0 : 0.0, c == 1 ? -1.0 : 0.0};
    element::SectionForce cut(element(i).unknowns().size());
    cut.forces = element(i).translation(along);
    add_end_forces(row, i, cut, false);
    if (map_.mesh.moved.contains(i)) add_moved_mass(row, i, -1, c, -1.0);
  }
  for (const PointMass& mass : scene_.masses) add_mass(row, mass, c, -1.0);
  for (const Spring& spring : scene_.springs)
    if (spring.against.empty()) add_spring(row, spring, false, -direction_of(spring)[c]);
  for (std::size_t i = 0; i < scene_.loads.size(); ++i) add_force(row, i, -1, c, 1.0);
  for (std::size_t k = 0; k < scene_.contacts.size(); ++k) add_contact(row, k, -1, c, -1.0);
}

namespace {

void add(element::SectionForce& to, const element::SectionForce& from, double factor) {
  to.forces += factor * from.forces;
  to.acceleration += factor * from.acceleration;
  to.deflection += factor * from.deflection;
  for (std::size_t c = 0; c < 2; ++c) to.load[c] += factor * from.load[c];
}

}  // namespace

SectionQuantity section_quantity(const OutputSpec& spec, Fibre fibre) {
  SectionQuantity wanted{spec.kind == OutputKind::stress ? OutputQuantity::stress : spec.quantity, fibre};
  if (spec.kind == OutputKind::stress && spec.quantity == OutputQuantity::N) wanted.M_factor = 0.0;
  if (spec.kind == OutputKind::stress && spec.quantity == OutputQuantity::M) wanted.N_factor = 0.0;
  wanted.intensification = spec.intensification;
  return wanted;
}

/// N is quadratic, V quartic and M quintic in x, because loads are constant, and inertia is linear along and cubic across.
std::size_t points_of(OutputQuantity quantity) {
  return quantity == OutputQuantity::N ? 3 : quantity == OutputQuantity::V ? 5 : 6;
}

std::size_t MemberForces::element_of(const MemberPath& way, std::size_t k) {
  return way.piece->first + (way.backwards ? way.piece->count - 1 - k : k);
}

std::pair<std::size_t, double> MemberForces::place_of(const MemberPath& way, double station) {
  const auto count = static_cast<double>(way.piece->count);
  // A station between two elements belongs to the next element along the path.
  const double element = std::clamp(std::floor(station * count), 0.0, count - 1.0);
  return {static_cast<std::size_t>(element), station * count - element};
}

element::SectionForce MemberForces::force(const MemberPath& way, std::size_t k, double x,
                                          OutputQuantity quantity) const {
  const std::size_t number = element_of(way, k);
  const element::FiniteElement& e = map_.mesh.element(number);
  element::SectionForce cut(e.unknowns().size());
  // If the path runs against the piece, left and right are exchanged, so M changes its sign.
  const double sign = way.backwards && quantity == OutputQuantity::M ? -1.0 : 1.0;
  add(cut, e.section_force(quantity, {way.backwards ? 1.0 - x : x, 0.0}, map_.axial_forces_in(number)), sign);
  return cut;
}

element::SectionForce MemberForces::section_force(const MemberPath& way, std::size_t k, double x,
                                                  const SectionQuantity& wanted, const SourcePlace& place,
                                                  const std::string& key) const {
  if (wanted.quantity != OutputQuantity::stress) return force(way, k, x, wanted.quantity);
  const element::FiniteElement& e = map_.mesh.element(element_of(way, k));
  const Member& member = scene_.members[static_cast<std::size_t>(e.member())];
  const Section& section = element::section_of(scene_, member);
  if ((wanted.N_factor != 0.0 && section.area == 0.0) || (wanted.M_factor != 0.0 && section.modulus == 0.0))
    throw SceneError(place, key,
                     fmt::format("stresses of section '{}' cannot be computed: give it a shape (pipe, box, i "
                                 "or round), or area and modulus in addition to EA and EI",
                                 section.name));
  const std::optional<Bend>& bend = member.bend;
  const double i = wanted.intensification.value_or(bend ? bend->intensification : 1.0);
  const double side = wanted.fibre == Fibre::left ? -1.0 : 1.0;
  element::SectionForce cut(e.unknowns().size());
  if (wanted.N_factor != 0.0) add(cut, force(way, k, x, OutputQuantity::N), wanted.N_factor / section.area);
  if (wanted.M_factor != 0.0)
    add(cut, force(way, k, x, OutputQuantity::M), side * i * wanted.M_factor / section.modulus);
  return cut;
}

}  // namespace signorini::outputs
