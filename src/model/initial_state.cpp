#include "model/initial_state.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

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

/// Both have the contacts with friction.
void check_saved_contacts(const Scene& scene) {
  std::unordered_set<std::string> contacts, saved;
  for (const auto& [name, T] : scene.initial.saved->shears) saved.insert(name);
  for (const ContactSpec& contact : scene.contacts) {
    contacts.insert(contact.name);
    if (contact.friction.any() && !saved.contains(contact.name))
      refuse_saved(scene.initial, fmt::format("the saved state has no shear of contact '{}'", contact.name));
  }
  for (const auto& [name, T] : scene.initial.saved->shears)
    if (!contacts.contains(name))
      refuse_saved(scene.initial, fmt::format("the saved state has a contact '{}' and the scene none", name));
  for (const SavedState::Own& own : scene.initial.saved->own) {
    const auto same = std::find_if(scene.contacts.begin(), scene.contacts.end(),
                                   [&](const ContactSpec& contact) { return contact.name == own.contact; });
    if (same == scene.contacts.end() || !same->own || own.state >= same->own->states.size())
      refuse_saved(scene.initial,
                   fmt::format("the saved state has contact '{}' in state {} of a law of its own, "
                               "which the scene has not",
                               own.contact, own.state));
  }
}

/// Of a run: the degrees of freedom of the same names.
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
  for (int i = 0; i < map.size(); ++i) {
    state.u[i] = value_of(map.dofs[static_cast<std::size_t>(i)].displacement);
    state.v[i] = value_of(map.dofs[static_cast<std::size_t>(i)].velocity);
  }
  for (const ContactSpec& contact : scene.contacts)  // sliding points, which the shears stand for
    for (const char* of : {".slip", ".slip_rate"}) values.erase(contact.name + of);
  for (const auto& [name, value] : spec.saved->motions)
    if (values.contains(name) && !name.starts_with("support "))
      refuse_saved(spec, fmt::format("the saved state has {} and the scene not", name));
  return state;
}

}  // namespace

InitialState given_state(const Scene& scene, const DofMap& map) {
  const InitialSpec& spec = scene.initial;
  const int n = map.size();
  if (spec.saved) return saved_state(scene, map);
  if (map.matrices())
    return {given_vector(spec.u, n, spec, "run.initial.u"), given_vector(spec.v, n, spec, "run.initial.v")};
  InitialState state{Vector::Zero(n), Vector::Zero(n)};
  constexpr std::array<std::string_view, 6> names{"ux", "uy", "rz", "vx", "vy", "wz"};
  for (const auto& c : spec.components) {
    const std::string key = fmt::format("run.initial.{}.{}", c.node, c.component);
    const auto it = std::find(names.begin(), names.end(), c.component);
    if (it == names.end())
      throw SceneError(c.place, key,
                       fmt::format("found '{}', expected ux, uy, rz, vx, vy or wz", c.component));
    const auto index = static_cast<std::size_t>(it - names.begin());
    const int node = find_node(map.mesh, c.node, c.place, key);
    const int number = map.number[static_cast<std::size_t>(node)][index % 3];
    if (number == DofMap::absent)
      throw SceneError(c.place, key, fmt::format("node '{}' has no such degree of freedom", c.node));
    if (number == DofMap::fixed && c.value != 0.0)
      throw SceneError(c.place, key, fmt::format("found {}, expected 0: a support fixes it", c.value));
    if (number >= 0) (index < 3 ? state.u : state.v)[number] = c.value;
  }
  return state;
}

}  // namespace signorini
