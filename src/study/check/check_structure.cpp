// Mass, free motions, and stiffness of contact springs relative to the structure.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <unordered_map>

#include "base/text.hpp"
#include "model/assembly/contacts.hpp"
#include "model/assembly/dofs.hpp"
#include "model/assembly/loads.hpp"
#include "model/assembly/motion_names.hpp"
#include "model/modes/constrained_structure.hpp"
#include "model/modes/stability.hpp"
#include "model/statics/free_motions.hpp"
#include "model/statics/mechanisms.hpp"
#include "model/statics/static_system.hpp"
#include "study/check/check.hpp"

namespace signorini::checks {
namespace {

/// r^T M r; r: unit translation of all degrees of freedom whose name ends with `component`.
double moving_mass(const Model& model, std::string_view component) {
  Vector r = Vector::Zero(model.size());
  for (int i = 0; i < model.size(); ++i)
    if (std::string_view(model.dofs[static_cast<std::size_t>(i)].displacement).ends_with(component))
      r[i] = 1.0;
  return r.dot(model.mass * r);
}

assembly::DofMap map_of(const Scene& scene) {
  return scene.matrices ? assembly::number_matrices(*scene.matrices) : assembly::number_nodes(scene);
}

std::vector<bool> closed_ones(const Model& model, const std::vector<ContactSample>& contacts) {
  std::vector<bool> closed;
  for (const ContactSample& c : contacts) closed.push_back(!is_open(c.state));
  closed.resize(model.contacts.size(), false);
  return closed;
}

/// Factor for the stiffness of the springs that replace rigid contacts. With prestress (run.geometric) the
/// factor is larger, because contacts may have to stabilise the structure.
double replacement_stiffness_factor(const Model& model) { return model.geometric ? 1e6 : 1.0; }

}  // namespace

std::vector<std::string> loose_parts(const Scene& scene) {
  std::set<std::string> nodes, sections;
  for (const Member& m : scene.members) {
    nodes.insert(m.nodes.begin(), m.nodes.end());
    sections.insert(m.section);
  }
  for (const PointMass& m : scene.masses) nodes.insert(m.node);
  for (const RigidBody& body : scene.rigid) nodes.insert(body.nodes.begin(), body.nodes.end());
  for (const Spring& s : scene.springs) nodes.insert({s.node, s.against});
  for (const ContactSpec& c : scene.contacts)
    for (const auto& direction : {c.normal, c.tangent})
      if (direction) nodes.insert(direction->node);
  for (const BodySpec& body : scene.bodies)
    for (const PlaneMesh::Element& e : body.mesh.elements)
      for (const int n : e.nodes) nodes.insert(scene.nodes[static_cast<std::size_t>(n)].name);
  std::vector<std::string> loose, unused, result;
  for (const Node& node : scene.nodes)
    if (!nodes.contains(node.name)) loose.push_back(node.name);
  for (const Section& section : scene.sections)
    if (!sections.contains(section.name)) unused.push_back(section.name);
  if (!loose.empty())
    result.push_back(fmt::format("no member, mass, spring or contact is attached to node{} {}",
                                 loose.size() > 1 ? "s" : "", base::join_quoted(loose, 5)));
  if (!unused.empty())
    result.push_back(fmt::format("{} {} not used by any member", unused.size() > 1 ? "sections" : "section",
                                 base::join_quoted(unused, 5) + (unused.size() > 1 ? " are" : " is")));
  return result;
}

std::string unstable_motion(const Scene& scene, const Model& model,
                            const std::vector<ContactSample>& contacts) {
  const Vector load = assembly::static_load(model.loads, model.size());
  const assembly::DofMap map = map_of(scene);
  const statics::StaticProblem problem{model.stiffness, load, model.contacts, map,
                                       replacement_stiffness_factor(model)};
  const auto growth = modes::fastest_growth(problem.matrix(closed_ones(model, contacts)), model.mass);
  if (!growth) return "";
  const std::string pace =
      std::isfinite(growth->rate)
          ? fmt::format("grows like exp({:.4g} t) unless friction prevents the growth", growth->rate)
          : std::string("grows without delay, because this motion moves no mass");
  return fmt::format(
      "the structure is unstable: its stiffness matrix has a negative eigenvalue, and the {} {}",
      assembly::describe_motion(growth->motion, map), pace);
}

check::MassFacts mass_of(const Scene& scene, const Model& model) {
  check::MassFacts facts;
  double mx = 0.0, my = 0.0;
  std::unordered_map<std::string, const Node*> nodes;
  for (const Node& node : scene.nodes) nodes.emplace(node.name, &node);
  const auto add = [&](double mass, double x, double y) {
    facts.total += mass;
    mx += mass * x;
    my += mass * y;
  };
  const element::Mesh mesh = element::make_mesh(scene);
  for (const auto& e : mesh.elements) {
    // The nodes share the element's mass as they share a uniform load along x.
    const element::ElementVector shares = e->load_vector({1.0 / e->extent(), 0.0});
    const std::vector<element::ElementUnknown> unknowns = e->unknowns();
    double x = 0.0, y = 0.0;
    for (std::size_t j = 0; j < unknowns.size(); ++j) {
      if (unknowns[j].component != 0) continue;
      const element::MeshNode& node = mesh.node(e->nodes()[unknowns[j].local_node]);
      x += shares[static_cast<Eigen::Index>(j)] * node.x;
      y += shares[static_cast<Eigen::Index>(j)] * node.y;
    }
    add(e->density() * e->extent(), x, y);
  }
  for (const PointMass& point : scene.masses) {
    const Node& node = *nodes.at(point.node);
    add(point.mass, node.x, node.y);
  }
  if (facts.total > 0.0) facts.x = mx / facts.total, facts.y = my / facts.total;
  facts.moving_x = moving_mass(model, ".ux");
  facts.moving_y = moving_mass(model, ".uy");
  return facts;
}

namespace {

/// The structure without sliding points (model/rigid_contacts.hpp), which are the last degrees of freedom. In a free
/// motion the springs of these points have no elongation, so the points have no independent motion.
struct WithoutSlipPoints {
  WithoutSlipPoints(const Model& model, int own) : contacts(model.contacts), size(own) {
    stiffness = model.stiffness.topLeftCorner(own, own);
    load = assembly::static_load(model.loads, model.size()).head(own);
    for (Contact& contact : contacts) contact.tangent = contact.body_tangent();
  }
  /// Extends a free motion of the structure to sliding points. Each point moves with its body; a point that
  /// is measured relative to its body has no motion.
  [[nodiscard]] Vector with_points(const Model& model, const Vector& motion) const {
    Vector all = Vector::Zero(model.size());
    all.head(size) = motion;
    for (const Contact& contact : model.contacts)
      if (contact.sliding_point() && contact.tangent.terms.size() == 1)
        all[contact.tangent.terms.front().first] = contact.body_tangent().dot(motion);
    return all;
  }

  SparseMatrix stiffness;
  Vector load;
  std::vector<Contact> contacts;
  int size;
};

}  // namespace

std::vector<std::string> free_motions(const Scene& scene, const Model& model,
                                      const std::vector<ContactSample>& contacts) {
  if (model.static_start) return model.statics.free_motions;
  const assembly::DofMap map = map_of(scene);
  const WithoutSlipPoints own(model, std::min(map.size(), model.size()));
  const statics::StaticProblem problem{own.stiffness, own.load, own.contacts, map,
                                       replacement_stiffness_factor(model)};
  const std::vector<bool> closed = closed_ones(model, contacts);
  const Vector load = assembly::static_load(model.loads, model.size());
  const SparseMatrix k =
      statics::StaticProblem{model.stiffness, load, model.contacts, map, replacement_stiffness_factor(model)}
          .matrix(closed);
  std::vector<std::string> names;
  for (const statics::FreeMotion& f :
       statics::constrain_free_motions(problem, statics::null_motions(k).topRows(own.size), closed, true)) {
    // A contact without friction follows the motion and does not restrain it.
    std::vector<std::size_t> holders;
    for (const std::size_t c : f.contacts)
      if (closed[c] && model.contacts[c].has_friction()) holders.push_back(c);
    names.push_back(assembly::describe_motion(f.motion, map) +
                    (!holders.empty() ? ", restrained only by friction at " +
                                            statics::names_of_contacts(model.contacts, holders)
                     : modes::has_negative_energy(k, own.with_points(model, f.motion))
                         ? std::string(", unstable")
                         : std::string(", not restrained")));
  }
  return names;
}

std::vector<check::StiffnessRatio> stiffness_ratios(const Model& model) {
  const std::vector<bool> all(model.contacts.size(), true);
  const modes::ContactConstraints holding = modes::constrain_contacts(model.contacts, all);
  const SparseMatrix k = assembly::with_springs(model.stiffness, holding.springs);
  if (holding.springs.empty() ||
      statics::null_motions(modes::with_constraint_springs(k, holding.fixed)).cols() > 0)
    return {};
  const modes::ConstrainedStructure structure(k, holding.fixed);
  std::vector<check::StiffnessRatio> result;
  const auto add = [&](std::size_t contact, bool normal, const Combination& form, double stiffness) {
    const double give = form.dot(structure.solve(assembly::dense_vector(form, model.size())));
    // 1 / give is the stiffness of the spring and the rest of the structure in parallel. A rest below
    // rounding is regarded as zero.
    const double rest = give > 0.0 ? 1.0 / give - stiffness : 0.0;
    result.push_back({static_cast<int>(contact), normal, stiffness, rest > 1e-12 * stiffness ? rest : 0.0});
  };
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const Contact& c = model.contacts[i];
    if (const auto kn = c.normal_spring()) add(i, true, c.normal, *kn);
    if (const auto kt = c.tangent_spring(); kt && !c.body_tangent().terms.empty())
      add(i, false, c.body_tangent(), *kt);
  }
  return result;
}

}  // namespace signorini::checks
