// transition.hpp: which state a contact takes when one of its guards has failed.
//
//   guard failed    from     to
//   separation      closed   open (inside while g < 0, which a dashpot makes possible)
//   open gap        inside   open
//   closing         open     stick  iff  kt |ut^(m)| <= fs kn |g^(m)|, else slip s = sign ut^(m)
//                            (m: the first derivative of g that is not zero; p := ut, so T = 0)
//   friction limit  stick    slip s,  p := ut - s fk |N| / kt
//   slip rate       slip s   stick,   p := ut - T / kt
//
// Forces and velocities are continuous for contacts with elements, so each decides alone from its own
// one-sided derivatives; contacts without tangential stiffness are tried this way too, and the caller
// repeats until every guard of the new states holds (decide/decider.hpp).
// Source: Lukashevich et al. 2021, section on contact states; the closing rule is the apex of the cone.
#pragma once

#include <array>

#include "contact/law.hpp"

namespace signorini {

/// The motion of one contact to the right of an instant: element k is the k-th time derivative.
/// `noise` has the same shape: what one rounding of the data makes of each entry.
struct MotionJet {
  static constexpr std::size_t orders = 5;  ///< the motion and four derivatives: enough to decide states
  std::array<ContactMotion, orders> motion, noise;
};

/// The state that slips in a direction, and that of a contact which bears a load and does not slip.
[[nodiscard]] State slip_along(double direction);
[[nodiscard]] State state_at_rest(const Contact& contact);
/// What a contact that carries nothing is: a dashpot may let go before the gap has opened.
[[nodiscard]] State let_go(const Contact& contact, double gap);

/// The next state of one contact; `failed` is a guard of `now`, `jet` holds in state `now`.
[[nodiscard]] ContactState next_state(const Contact& contact, const ContactState& now, Guard failed,
                                      const MotionJet& jet);

}  // namespace signorini
