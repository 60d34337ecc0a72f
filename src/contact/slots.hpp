// slots.hpp: index of a contact's guards among the guards of all contacts: three per contact, in the order of
// contact/law.hpp. Index of its forces: signorini/force_layout.hpp.
#pragma once

#include <cstddef>

namespace signorini {

inline constexpr std::size_t guards_per_contact = 3;

[[nodiscard]] constexpr std::size_t guard_count(std::size_t contacts) {
  return guards_per_contact * contacts;
}
/// Index among the guards of all contacts, and the contact and guard of such an index.
[[nodiscard]] constexpr std::size_t guard_slot(std::size_t contact, std::size_t guard) {
  return guards_per_contact * contact + guard;
}
[[nodiscard]] constexpr std::size_t contact_of_guard(std::size_t slot) { return slot / guards_per_contact; }
[[nodiscard]] constexpr std::size_t guard_within(std::size_t slot) { return slot % guards_per_contact; }

}  // namespace signorini
