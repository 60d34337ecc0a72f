#include "model/initial_state.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "base/listed.hpp"
#include "contact/friction.hpp"
#include "scene/components.hpp"
#include "scene/saved_state.hpp"
#include "signorini/error.hpp"

namespace signorini {
namespace {

Vector given_vector(const std::vector<double>& values, int n, const InitialSpec& spec, const char* key) {
  if (values.empty()) return Vector::Zero(n);
  if (static_cast<int>(values.size()) != n)
    throw SceneError(spec.place, key,
                     fmt::format("found {} numbers, expected one for each of the {} degrees of freedom",
                                 values.size(), n));
  return Eigen::Map<const Vector>(values.data(), n);
}

[[noreturn]] void refuse_saved(const InitialSpec& spec, const std::string& why) {
  throw SceneError(spec.place, "run.initial.run", why + ": expected a run of the same structure");
}

/// Checks that the run and the scene have the same contacts with friction.
void check_saved_contacts(const Scene& scene) {
  std::unordered_set<std::string> contacts, saved;
  for (const auto& [name, T] : scene.initial.saved->shears) saved.insert(name);
  for (const ContactSpec& contact : scene.contacts) {
    contacts.insert(contact.name);
    if (contact.friction.any() && !saved.contains(contact.name))
      refuse_saved(scene.initial, fmt::format("the saved state has no shear of contact '{}'", contact.name));
    if (contact.friction.any() && contact.tangential_damping > 0.0 &&
        !saved_motion(*scene.initial.saved, contact.name + ".slip"))
      refuse_saved(scene.initial, fmt::format("the saved state has no {}.slip, which a contact with "
                                              "tangential_damping needs",
                                              contact.name));
  }
  for (const auto& [name, T] : scene.initial.saved->shears)
    if (!contacts.contains(name))
      refuse_saved(scene.initial, fmt::format("the saved state has a contact '{}' and the scene none", name));
  for (const SavedState::Own& own : scene.initial.saved->own) {
    const auto same = std::find_if(scene.contacts.begin(), scene.contacts.end(),
                                   [&](const ContactSpec& contact) { return contact.name == own.contact; });
    if (same == scene.contacts.end() || own.state >= same->contact_law()->own_states().size())
      refuse_saved(scene.initial,
                   fmt::format("the saved state has contact '{}' in state {} of a law of its own, "
                               "which the scene has not",
                               own.contact, own.state));
  }
}

std::string key_of(const InitialSpec::Component& c) {
  return fmt::format("run.initial.{}.{}", c.node, c.component);
}

/// State of a run: values of the degrees of freedom with the same names.
InitialState saved_state(const Scene& scene, const DofMap& map) {
  const InitialSpec& spec = scene.initial;
  InitialState state{Vector::Zero(map.size()), Vector::Zero(map.size())};
  std::unordered_map<std::string, double> values;
  for (const auto& [name, value] : spec.saved->motions) values.emplace(name, value);
  const auto value_of = [&](const std::string& name) {
    const auto found = values.find(name);
    if (found == values.end()) refuse_saved(spec, fmt::format("the saved state has no {}", name));
    const double value = found->second;
    values.erase(found);
    return value;
  };
  check_saved_contacts(scene);
  values.erase(saved_alpha);
  for (int i = 0; i < map.size(); ++i) {
    state.u[i] = value_of(map.dofs[static_cast<std::size_t>(i)].displacement);
    state.v[i] = value_of(map.dofs[static_cast<std::size_t>(i)].velocity);
  }
  for (const TiedDof& tied : map.tied) {  // they follow others
    values.erase(tied.dof.displacement);
    values.erase(tied.dof.velocity);
  }
  for (const ContactSpec& contact : scene.contacts)  // sliding points and surfaces; contacts take their
                                                     // values
    for (const char* of : {".slip", ".slip_rate", ".surface"}) values.erase(contact.name + of);
  for (const auto& [name, value] : spec.saved->motions)
    if (values.contains(name) && !name.starts_with("support "))
      refuse_saved(spec, fmt::format("the saved state has {} and the scene not", name));
  return state;
}

}  // namespace

namespace {

/// Index of a given component; nullopt: the degree of freedom is fixed.
struct GivenPlace {
  bool velocity = false;
  int dof = 0;
};
/// The degrees of freedom that a tied motion follows.
std::string given_for(const DofMap& map, int tied) {
  std::vector<std::string> names;
  for (const TiedTerm& term : map.terms(tied))
    if (term.number >= 0) names.push_back(map.dofs[static_cast<std::size_t>(term.number)].displacement);
  return names.empty() ? std::string("none: supports move it") : listed(names, 3);
}

std::optional<GivenPlace> place_of(const InitialSpec::Component& c, const DofMap& map) {
  const std::string key = key_of(c);
  const auto named = component_named(c.component);
  if (!named || named->name() != c.component)
    throw SceneError(c.place, key, fmt::format("found '{}', expected ux, uy, rz, vx, vy or wz", c.component));
  const int node = find_node(map.mesh, c.node, c.place, key);
  const int number = map.number[static_cast<std::size_t>(node)][named->index];
  if (number == DofMap::absent)
    throw SceneError(c.place, key, fmt::format("node '{}' has no such degree of freedom", c.node));
  if (number == DofMap::fixed && c.value != 0.0)
    throw SceneError(c.place, key, fmt::format("found {}, expected 0: a support fixes it", c.value));
  if (map.is_tied(number) && map.body[static_cast<std::size_t>(node)] < 0)
    return std::nullopt;  // a tied seam
  if (map.is_tied(number))
    throw SceneError(
        c.place, key,
        fmt::format("found a motion of node '{}', which follows from others as part of a rigid body, "
                    "expected one of {}",
                    c.node, given_for(map, number)));
  if (number < 0) return std::nullopt;
  return GivenPlace{named->rate, number};
}

/// True for each degree of freedom whose initial displacement a damper, or a contact's dashpot or friction, needs.
std::vector<bool> begins_from(const Model& model) {
  std::vector<bool> result(static_cast<std::size_t>(model.size()), false);
  for (int k = 0; k < model.damping.outerSize(); ++k)
    for (SparseMatrix::InnerIterator it(model.damping, k); it; ++it)
      if (it.value() != 0.0) result[static_cast<std::size_t>(it.row())] = true;
  for (const Contact& contact : model.contacts) {
    if (contact.normal_damping != 0.0 || !contact.obeys_coulomb())
      for (const auto& term : contact.normal.terms) result[static_cast<std::size_t>(term.first)] = true;
    if (contact.has_friction() || !contact.obeys_coulomb())
      for (const auto& term : contact.tangent.terms) result[static_cast<std::size_t>(term.first)] = true;
  }
  return result;
}

/// Warning for a value given for a degree of freedom without mass.
std::string unused(const Model& model, const GivenPlace& at, double value, const SourcePlace& place,
                   const std::string& key) {
  const Dof& dof = model.dofs[static_cast<std::size_t>(at.dof)];
  const double unit = (dof.rotation ? 1.0 : model.unit.length) / (at.velocity ? model.unit.time : 1.0);
  const std::string what =
      at.velocity ? fmt::format("{} has no mass, so its velocity follows from the forces", dof.displacement)
                  : fmt::format("{} has no mass and no damper, so it follows the forces immediately",
                                dof.displacement);
  return SceneError(
             place, key,
             fmt::format("the initial value {:.9g} is ignored: {}; give it a mass{}, or remove this value",
                         value * unit, what, at.velocity ? "" : " or a damper"))
      .what();
}

}  // namespace

std::vector<std::string> unused_values(const Scene& scene, const DofMap& map, const Model& model) {
  const InitialSpec& spec = scene.initial;
  if (spec.saved || scene.reduction) return {};
  const std::vector<bool> begins = begins_from(model);
  std::vector<std::string> result;
  const auto check = [&](const GivenPlace& at, double value, const SourcePlace& place,
                         const std::string& key) {
    const auto dof = static_cast<std::size_t>(at.dof);
    if (value == 0.0 || !model.dofs[dof].massless || (!at.velocity && begins[dof])) return;
    result.push_back(unused(model, at, value, place, key));
  };
  for (const auto& c : spec.components)
    if (const auto at = place_of(c, map)) check(*at, c.value, c.place, key_of(c));
  for (std::size_t i = 0; i < spec.u.size(); ++i)
    check({false, static_cast<int>(i)}, spec.u[i], spec.place, fmt::format("run.initial.u[{}]", i));
  for (std::size_t i = 0; i < spec.v.size(); ++i)
    check({true, static_cast<int>(i)}, spec.v[i], spec.place, fmt::format("run.initial.v[{}]", i));
  return result;
}

InitialState given_state(const Scene& scene, const DofMap& map) {
  const InitialSpec& spec = scene.initial;
  const int n = map.size();
  if (spec.saved) return saved_state(scene, map);
  if (map.matrices())
    return {given_vector(spec.u, n, spec, "run.initial.u"), given_vector(spec.v, n, spec, "run.initial.v")};
  InitialState state{Vector::Zero(n), Vector::Zero(n)};
  for (const auto& c : spec.components)
    if (const auto at = place_of(c, map)) (at->velocity ? state.v : state.u)[at->dof] = c.value;
  return state;
}

}  // namespace signorini
