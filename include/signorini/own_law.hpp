// own_law.hpp: a contact law of one's own, beside the built-in ones; for `ida` and `exact`.
//
//   in state i      normal_i(N, T, g, ut, g', ut', p) = 0     two rows, from which N and T follow
//                   tangent_i(N, T, g, ut, g', ut', p) = 0
//   it holds while  guard_ij(N, T, g, ut, g', ut', p) > 0     at most three, to which products of forms may be added
//   where one falls i <- next, p <- memory(N, T, g, ut, g', ut') if given
//
// All are linear forms (form.hpp), with a coefficient for the memory p, a length: what an anchor is to friction,
// or a dent to what was crushed. There is N in every normal row and T in every tangent row; forms on
// accelerations are refused.
//
//   auto pad = std::make_shared<OwnLaw>();         a pad that yields at -Y (src/contact/law/yielding_pad.cpp)
//   pad->states = {{"off", State::open, {{.N = 1}}, {{.T = 1}}, {{{{.gap = 1}, -1}, 1}}},
//                  {"on", State::closed, ...}};
//   scene.contacts[0].own = pad;
//
// The contact is `compliant` besides: its normal_stiffness is the size of the law's stiffness, by which
// tolerances, scales and frequencies go. It starts in state 0 with p = 0, or where last_state() has left it;
// guards that do not hold there lead on at once, as after every instant, until all hold. A static start knows
// built-in laws only.
// Energy: all that such a contact takes, what it stores too, counts as its friction work; conditions (6) and (7)
// are not its own and are not audited. Files show the kind of a state; a change between two closed states is a
// `stick` where it ends a slip, else a `slip`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signorini/form.hpp"

namespace signorini {

/// form + memory p.
struct OwnForm {
  Form form;
  double memory = 0.0;  ///< times p
};

struct OwnGuard {
  OwnForm positive;                        ///< while the state holds
  std::size_t next = 0;                    ///< the state after it has fallen
  std::optional<Form> memory = {};         ///< p from then on; absent: as it was
  std::vector<FormProduct> products = {};  ///< to be added to `positive`: F^2 - T^2 = (F - T)(F + T)
};

struct OwnState {
  std::string name;          ///< in messages
  State kind = State::open;  ///< what files and events call it: open, closed, stick, slip_plus or slip_minus
  OwnForm normal, tangent;   ///< = 0
  std::vector<OwnGuard> guards = {};  ///< at most three
};

struct OwnLaw {
  std::string name = {};         ///< in check, messages and summary.json; empty: "compliant", as its springs
  std::vector<OwnState> states;  ///< at most most_own_states; the first one is where a run begins
};

}  // namespace signorini
