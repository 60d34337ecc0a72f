// slots.hpp: where the forces and guards of a contact stand among those of all.
//
//   forces  N_1, T_1, N_2, T_2, ...        guards  three a contact, in the order of contact/law.hpp
#pragma once

#include <cstddef>

namespace signorini {

inline constexpr std::size_t guards_per_contact = 3;

/// Index among the forces of all contacts.
[[nodiscard]] constexpr std::size_t normal_slot(std::size_t contact) { return 2 * contact; }
[[nodiscard]] constexpr std::size_t tangent_slot(std::size_t contact) { return 2 * contact + 1; }

[[nodiscard]] constexpr std::size_t guard_count(std::size_t contacts) {
  return guards_per_contact * contacts;
}
/// Index among the guards of all contacts, and whose it is.
[[nodiscard]] constexpr std::size_t guard_slot(std::size_t contact, std::size_t guard) {
  return guards_per_contact * contact + guard;
}
[[nodiscard]] constexpr std::size_t contact_of_guard(std::size_t slot) { return slot / guards_per_contact; }
[[nodiscard]] constexpr std::size_t guard_within(std::size_t slot) { return slot % guards_per_contact; }

}  // namespace signorini
