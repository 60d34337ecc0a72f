// mode.hpp: the states of all contacts together.
#pragma once

#include <vector>

#include "signorini/contact.hpp"

namespace signorini {

/// One entry per contact, in the order of Model::contacts.
using Mode = std::vector<ContactState>;

/// State that represents all states with the same rows: all open states of the built-in laws have the same rows.
[[nodiscard]] constexpr State state_of_rows(State state) {
  return is_open(state) && !is_own(state) ? State::open : state;
}

/// States of a mode, which determine the matrix of its system; anchors are constants of rows and do not.
[[nodiscard]] inline std::vector<State> states_of(const Mode& mode) {
  std::vector<State> states(mode.size());
  for (std::size_t k = 0; k < mode.size(); ++k) states[k] = state_of_rows(mode[k].state);
  return states;
}

}  // namespace signorini
