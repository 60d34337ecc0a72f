// user_contact_law.hpp: a user contact law, in addition to the built-in ones; for `ida` and `exact`.
//
//   in state i      normal_i(N, T, g, ut, g', ut', p) = 0     two rows, from which N and T follow
//                   tangent_i(N, T, g, ut, g', ut', p) = 0
//   valid while     guard_ij(N, T, g, ut, g', ut', p) > 0     at most three, with optional products of forms
//   at their zero   i <- next, p <- memory(N, T, g, ut, g', ut') if given
//
// All are linear forms (form.hpp), with a coefficient for the memory p. p is a length, such as the anchor of
// friction or the dent of crushed material. Every normal row must contain N, every tangent row T; forms on
// accelerations are refused.
//
//   auto pad = std::make_shared<UserContactLaw>();         a pad that yields at -Y (src/contact/law/yielding_pad.cpp)
//   pad->states = {{"off", State::open, {{.N = 1}}, {{.T = 1}}, {{{{.gap = 1}, -1}, 1}}},
//                  {"on", State::closed, ...}};
//   scene.contacts[0].user_law = pad;
//
// The contact also is `compliant`: its normal_stiffness must have the magnitude of the law's stiffness; tolerances,
// scales and frequencies depend on it. It starts in state 0 with p = 0, or in the state given by last_state(); if
// guards do not hold there, the state changes at once until all hold, as after every instant. A static start supports
// built-in laws only.
// Energy: all energy that such a contact takes, stored energy included, counts as its friction work; conditions (6) and
// (7) do not apply to it and are not audited. Files contain the kind of a state; a change between two closed states is
// a `stick` if it ends a slip, else a `slip`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signorini/form.hpp"

namespace signorini {

/// The value form + memory p.
struct UserLawForm {
  Form form;
  double memory = 0.0;  ///< factor of p
};

struct UserLawGuard {
  UserLawForm positive;                    ///< while the state holds
  std::size_t next = 0;                    ///< the state after the guard has reached zero
  std::optional<Form> memory = {};         ///< p from then on; absent: unchanged
  std::vector<FormProduct> products = {};  ///< to be added to `positive`: F^2 - T^2 = (F - T)(F + T)
};

struct UserLawState {
  std::string name;          ///< name for messages
  State kind = State::open;  ///< kind shown in files and events: open, closed, stick, slip_plus or slip_minus
  UserLawForm normal, tangent;            ///< = 0
  std::vector<UserLawGuard> guards = {};  ///< at most three
};

struct UserContactLaw {
  std::string name = {};             ///< name in check, messages and summary.json; empty: "compliant"
  std::vector<UserLawState> states;  ///< at most max_user_law_states; a run begins in the first one
};

}  // namespace signorini
