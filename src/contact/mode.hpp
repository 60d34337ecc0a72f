// mode.hpp: the states of all contacts together.
#pragma once

#include <vector>

#include "signorini/contact.hpp"

namespace signorini {

/// One entry a contact, in the order of Model::contacts.
using Mode = std::vector<ContactState>;

/// The state that has the same rows: what is open has the same wherever it is.
[[nodiscard]] constexpr State state_of_rows(State state) {
  return is_open(state) && !is_own(state) ? State::open : state;
}

/// What of a mode stands in the matrix of its system: anchors are constants of rows.
[[nodiscard]] inline std::vector<State> states_of(const Mode& mode) {
  std::vector<State> states(mode.size());
  for (std::size_t k = 0; k < mode.size(); ++k) states[k] = state_of_rows(mode[k].state);
  return states;
}

}  // namespace signorini
