// contact_states.hpp: the states of all contacts together, and the layout of their forces.
#pragma once

#include <cstddef>
#include <vector>

#include "signorini/contact.hpp"
#include "signorini/force_layout.hpp"

namespace signorini::contact {

/// One entry per contact, in the order of Model::contacts.
using ContactStates = std::vector<ContactState>;

/// Representative of all states with the same rows: State::open for every open state of the built-in laws.
[[nodiscard]] constexpr State representative_state(State state) {
  return is_open(state) && !is_user_law_state(state) ? State::open : state;
}

/// Representative state of each contact, without the anchor. These states determine the matrix of the state system; anchors
/// enter only the constants of rows.
[[nodiscard]] inline std::vector<State> states_of(const ContactStates& contact_states) {
  std::vector<State> states(contact_states.size());
  for (std::size_t k = 0; k < contact_states.size(); ++k)
    states[k] = representative_state(contact_states[k].state);
  return states;
}

/// Layout of the forces and guards of these contacts, from the capabilities of their laws.
[[nodiscard]] inline ForceLayout layout_of(const std::vector<Contact>& contacts) {
  std::vector<ForceLayout::Counts> counts;
  counts.reserve(contacts.size());
  for (const Contact& contact : contacts)
    counts.push_back({contact.law->capabilities.tangents, contact.law->capabilities.guards,
                      contact.unused_forces, contact.unused_guards});
  return ForceLayout(counts);
}

}  // namespace signorini::contact
