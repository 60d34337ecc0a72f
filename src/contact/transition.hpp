// transition.hpp: the next state of a contact after one of its guards has failed.
//
//   guard failed    from     to
//   separation      closed   open (inside while g < 0, which a dashpot makes possible)
//   open gap        inside   open
//   closing         open     stick  iff  kt |ut^(m)| <= fs kn |g^(m)|, else slip s = sign ut^(m)
//                            (m: the first derivative of g that is not zero; p := ut, so T = 0)
//   friction limit  stick    slip s,  p := ut - s fk |N| / kt
//   slip rate       slip s   stick,   p := ut - T / kt
//
// Forces and velocities are continuous for contacts with elements, so each one is decided separately from its own
// one-sided derivatives. Contacts without tangential stiffness are tried in the same way, and the caller repeats until
// every guard of the new states holds (decide/decider.hpp).
// Source: Lukashevich et al. 2021, section on contact states; the closing rule is the apex of the cone.
#pragma once

#include <array>

#include "contact/law.hpp"

namespace signorini {

/// Motion of one contact just after an instant: element k is the k-th time derivative. `noise` has the same shape: the
/// error of each entry caused by one rounding of the data.
struct MotionJet {
  static constexpr std::size_t orders = 5;  ///< the motion and four derivatives, enough to decide states
  std::array<ContactMotion, orders> motion, noise;
};

/// State that slips in a direction; state of a contact that bears a load and does not slip.
[[nodiscard]] State slip_along(double direction);
[[nodiscard]] State state_at_rest(const Contact& contact);
/// State of a contact without force: with a dashpot the force may vanish before the gap has opened.
[[nodiscard]] State let_go(const Contact& contact, double gap);

/// The next state of one contact; `failed` is a guard of `now`, `jet` is the motion in state `now`.
[[nodiscard]] ContactState next_state(const Contact& contact, const ContactState& now, Guard failed,
                                      const MotionJet& jet);

}  // namespace signorini
