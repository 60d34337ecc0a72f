// Mass, free motions, and contact springs against the structure.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "model/contacts.hpp"
#include "model/dofs.hpp"
#include "model/held.hpp"
#include "model/motion_names.hpp"
#include "model/null_motions.hpp"
#include "model/static_system.hpp"
#include "study/check_parts.hpp"

namespace signorini::checks {
namespace {

const Node& node_of(const Scene& scene, const std::string& name) {
  return *std::find_if(scene.nodes.begin(), scene.nodes.end(), [&](const Node& n) { return n.name == name; });
}

double mass_per_length(const Scene& scene, const std::string& section) {
  return std::find_if(scene.sections.begin(), scene.sections.end(),
                      [&](const Section& s) { return s.name == section; })
      ->mass_per_length;
}

/// r M r for a unit translation of all degrees of freedom whose names end so.
double moving_mass(const Model& model, std::string_view component) {
  Vector r = Vector::Zero(model.size());
  for (int i = 0; i < model.size(); ++i)
    if (std::string_view(model.dofs[static_cast<std::size_t>(i)].displacement).ends_with(component))
      r[i] = 1.0;
  return r.dot(model.mass * r);
}

}  // namespace

MassFacts mass_of(const Scene& scene, const Model& model) {
  MassFacts facts;
  double mx = 0.0, my = 0.0;
  const auto add = [&](double mass, double x, double y) {
    facts.total += mass;
    mx += mass * x;
    my += mass * y;
  };
  for (const Member& member : scene.members)
    for (std::size_t i = 0; i + 1 < member.nodes.size(); ++i) {
      const Node &a = node_of(scene, member.nodes[i]), &b = node_of(scene, member.nodes[i + 1]);
      add(mass_per_length(scene, member.section) * std::hypot(b.x - a.x, b.y - a.y), 0.5 * (a.x + b.x),
          0.5 * (a.y + b.y));
    }
  for (const PointMass& point : scene.masses) {
    const Node& node = node_of(scene, point.node);
    add(point.mass, node.x, node.y);
  }
  if (facts.total > 0.0) facts.x = mx / facts.total, facts.y = my / facts.total;
  facts.moving_x = moving_mass(model, ".ux");
  facts.moving_y = moving_mass(model, ".uy");
  return facts;
}

std::vector<std::string> free_motions(const Scene& scene, const Model& model,
                                      const std::vector<ContactSample>& contacts) {
  if (model.static_start) return model.statics.free_motions;
  const DofMap map = scene.matrices ? number_matrices(*scene.matrices) : number_nodes(scene);
  const Vector load = static_load(model.loads, model.size());
  const StaticProblem problem{model.stiffness, load, model.contacts, map};
  std::vector<bool> closed;
  for (const ContactSample& c : contacts) closed.push_back(c.state != State::open);
  closed.resize(model.contacts.size(), false);
  std::vector<std::string> names;
  for (const FreeMotion& f : hold_motions(problem, null_motions(problem.matrix(closed)), closed)) {
    // Without friction or a spring a contact follows the motion and does not hold it.
    const Contact* holder = f.holder < 0 ? nullptr : &model.contacts[static_cast<std::size_t>(f.holder)];
    const bool holds =
        holder != nullptr && closed[static_cast<std::size_t>(f.holder)] && holder->has_friction();
    names.push_back(describe_motion(f.motion, map) +
                    (holds ? fmt::format(", only held by friction at contact '{}'", holder->name)
                           : std::string(", held by nothing")));
  }
  return names;
}

std::vector<StiffnessRatio> stiffness_ratios(const Model& model) {
  const std::vector<bool> all(model.contacts.size(), true);
  const Holding holding = hold_contacts(model.contacts, all);
  const SparseMatrix k = with_springs(model.stiffness, holding.springs);
  if (holding.springs.empty() || null_motions(with_grips(k, holding.fixed)).cols() > 0) return {};
  const HeldStructure structure(k, holding.fixed);
  std::vector<StiffnessRatio> result;
  const auto add = [&](std::size_t contact, bool normal, const Combination& form, double stiffness) {
    const double give = form.dot(structure.solve(full(form, model.size())));
    // 1 / give is the spring and the rest side by side; below roundoff there is no rest.
    const double rest = give > 0.0 ? 1.0 / give - stiffness : 0.0;
    result.push_back({static_cast<int>(contact), normal, stiffness, rest > 1e-12 * stiffness ? rest : 0.0});
  };
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const Contact& c = model.contacts[i];
    if (c.law == Law::compliant) add(i, true, c.normal, c.normal_stiffness);
    if (c.tangential_stiffness && !c.tangent.terms.empty()) add(i, false, c.tangent, *c.tangential_stiffness);
    if (c.shear) add(i, false, c.shear->body, c.shear->stiffness);
  }
  return result;
}

}  // namespace signorini::checks
