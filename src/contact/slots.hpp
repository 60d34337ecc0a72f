// slots.hpp: where the guards of a contact stand among those of all: three a contact, in the order of contact/law.hpp.
// Where its forces stand: signorini/force_layout.hpp.
#pragma once

#include <cstddef>

namespace signorini {

inline constexpr std::size_t guards_per_contact = 3;

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
