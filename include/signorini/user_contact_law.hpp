// user_contact_law.hpp: a contact law defined by the user, for the engines `ida` and `exact`.
//
//   in state i      normal_i(N, T, g, ut, g', ut', p) = 0     two rows, from which N and T follow
//                   tangent_i(N, T, g, ut, g', ut', p) = 0
//   valid while     guard_ij(N, T, g, ut, g', ut', p) > 0     at most three, with optional products of forms
//   at its zero     i <- next, p <- memory(N, T, g, ut, g', ut') if given
//
// Rows and guards are linear forms (form.hpp) with an additional coefficient for the memory p. p is a length, such as the
// anchor of friction or the dent of crushed material. Every normal row must contain N, every tangent row T; forms on
// accelerations are refused. With normal_force_given, the law is that of a slider: every normal row is N + q = 0, and the other
// forms may depend on q = normal_force(t) and q'.
//
//   auto pad = std::make_shared<UserContactLaw>();         a pad that yields at -Y (src/contact/law/yielding_pad.cpp)
//   pad->states = {{"off", State::open, {{.N = 1}}, {{.T = 1}}, {{{{.gap = 1}, -1}, 1}}},
//                  {"on", State::closed, ...}};
//   scene.contacts[0].user_law = pad;
//
// The contact also has the properties of `compliant`, or of `slider` with normal_force_given. Its normal_stiffness must have the
// magnitude of the law's stiffness, because tolerances, scales and frequencies depend on it. A run starts in state 0 with p = 0, or in the state given by
// last_state(). If guards are violated in this state, the state changes at once until all guards are positive, as at
// every instant. A static start supports built-in laws only.
// Energy: all work done on such a contact, stored or dissipated, is reported as its friction work. Conditions (6) and (7) do
// not apply and are not audited. Files contain the kind of a state; a change between two closed states is written as `stick`
// if it ends a slip, otherwise as `slip`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signorini/form.hpp"

namespace signorini {

/// A form that also depends on the memory p: form + memory p.
struct UserLawForm {
  Form form;
  double memory = 0.0;  ///< factor of p
};

struct UserLawGuard {
  UserLawForm positive;             ///< positive while the state is valid
  std::size_t next = 0;             ///< number of the state after the guard has reached zero
  std::optional<Form> memory = {};  ///< new value of p at the zero of the guard; absent: p is unchanged
  /// Terms added to `positive`, for example F^2 - T^2 = (F - T)(F + T).
  std::vector<FormProduct> products = {};
};

struct UserLawState {
  std::string name;             ///< name for messages
  State kind = State::open;     ///< kind in files and events: open, closed, stick, slip_plus or slip_minus
  UserLawForm normal, tangent;  ///< forms that are zero in this state
  std::vector<UserLawGuard> guards = {};  ///< at most three
};

struct UserContactLaw {
  /// Name in the output of `check`, in messages and in summary.json; empty: "compliant" or "slider".
  std::string name = {};
  std::vector<UserLawState> states;  ///< at most max_user_law_states; a run begins in the first one
  bool normal_force_given = false;   ///< true: the law of a slider
};

}  // namespace signorini
