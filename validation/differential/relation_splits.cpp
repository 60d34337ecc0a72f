// Relations of parts: one part as two that do the same together.
#include <algorithm>

#include "differential/random.hpp"
#include "differential/relation.hpp"

namespace signorini::differential {
namespace {

/// Its forces come from springs, of which two halves are one.
bool is_elastic(const ContactSpec& contact) {
  return !contact.user_law && !contact.friction.is_load_dependent() &&
         (contact.law == Law::compliant ||
          (contact.law == Law::slider && contact.tangential_stiffness.has_value()));
}

void halve(ContactSpec& contact) {
  contact.normal_stiffness *= 0.5;
  if (contact.tangential_stiffness) *contact.tangential_stiffness *= 0.5;
  contact.normal_damping *= 0.5;
  contact.tangential_damping *= 0.5;
  contact.initial_shear *= 0.5;
  contact.normal_force.offset *= 0.5;
  contact.normal_force.amplitude *= 0.5;
}

template <class Items, class Fits>
std::optional<std::size_t> one_of(const Items& items, std::uint64_t seed, const Fits& fits) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < items.size(); ++i)
    if (fits(items[i])) places.push_back(i);
  if (places.empty()) return std::nullopt;
  return places[static_cast<std::size_t>(Random(seed).integer(0, static_cast<int>(places.size()) - 1))];
}

}  // namespace

std::optional<Related> related_split_contact(const Scene& scene, std::uint64_t seed) {
  const auto place = one_of(scene.contacts, seed, is_elastic);
  if (!place) return std::nullopt;
  Related result{"contact split: " + scene.contacts[*place].name, scene};
  ContactSpec& half = result.scene.contacts[*place];
  halve(half);
  ContactSpec twin = half;
  twin.name += "_twin";
  twin.of_stop = false;
  twin.table.clear();
  result.twins[half.name] = twin.name;
  for (const OutputSpec& output : scene.outputs) {
    const bool shared = output.quantity != OutputQuantity::gap && output.quantity != OutputQuantity::slip;
    if (output.kind == OutputKind::contact && output.at.front() == half.name && shared)
      result.output_factors[output.name] = 0.5;
  }
  result.scene.contacts.push_back(std::move(twin));
  return result;
}

std::optional<Related> related_split_member(const Scene& scene, std::uint64_t seed) {
  const auto place = one_of(scene.members, seed, [&](const Member& member) {
    return member.type == MemberType::beam && !member.bend &&
           std::any_of(scene.sections.begin(), scene.sections.end(), [&](const Section& section) {
             return section.name == member.section && section.mass_per_length == 0.0;
           });
  });
  if (!place) return std::nullopt;
  Related result{"member split", scene};
  result.same_energy = false;  // that of the rows of what moves freely, where a support of the member moves
  for (int& elements : result.scene.members[*place].elements) elements *= 2;
  return result;
}

std::optional<Related> related_split_spring(const Scene& scene, std::uint64_t seed) {
  const auto place = one_of(scene.springs, seed, [](const Spring&) { return true; });
  if (!place) return std::nullopt;
  Related result{"spring split", scene};
  Spring& half = result.scene.springs[*place];
  for (double* x :
       {&half.stiffness, &half.damping, &half.rotation_stiffness, &half.rotation_damping, &half.preload})
    *x *= 0.5;
  const Spring twin = half;
  result.scene.springs.push_back(twin);
  for (const OutputSpec& output : scene.outputs)
    if (output.kind == OutputKind::spring && output.spring == *place)
      result.output_factors[output.name] = 0.5;
  return result;
}

}  // namespace signorini::differential
