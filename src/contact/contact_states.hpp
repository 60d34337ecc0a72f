// contact_states.hpp: the states of all contacts together.
#pragma once

#include <cstddef>
#include <vector>

#include "signorini/contact.hpp"

namespace signorini::contact {

/// One entry per contact, in the order of Model::contacts.
using ContactStates = std::vector<ContactState>;

/// State that represents all states with the same rows: all open states of the built-in laws have the same rows.
[[nodiscard]] constexpr State representative_state(State state) {
  return is_open(state) && !is_user_law_state(state) ? State::open : state;
}

/// States without anchors. They determine the matrix of the state system; anchors are constants of rows and do not.
[[nodiscard]] inline std::vector<State> states_of(const ContactStates& contact_states) {
  std::vector<State> states(contact_states.size());
  for (std::size_t k = 0; k < contact_states.size(); ++k)
    states[k] = representative_state(contact_states[k].state);
  return states;
}

// Index of a contact's guards among the guards of all contacts: three per contact, in the order of
// contact/law.hpp. Index of its forces: signorini/force_layout.hpp.

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

}  // namespace signorini::contact
