// law.hpp: rows and guards of a contact in each of its states.
//
//   law        open            closed, stick, slip: normal   stick                        slip s
//   compliant  N = 0, T = 0    N - kn g = 0                  T - kt (ut - p) = 0          T + s fk N = 0
//   rigid      N = 0, T = 0    g'' = 0                       ut'' = 0                     T + s fk N = 0
//   slider     N + q = 0       N + q = 0                     as compliant, or ut'' = 0    T + s fk N = 0
//   with a shear element, whose sliding point is massless:   p' = 0                       T + s fk N = 0
//   static limit in direction s, without slip (other contacts prevent slip):              T + s fs N = 0
//   Friction that depends on N has the row T - s F = 0, F(|N|): contact/friction.hpp.
// A dashpot adds cn g' to kn g. The contact opens at N = 0, because it must not pull, although g is still negative. The contact
// stays open (state "inside") until kn g + cn g' < 0 again or until the gap has opened.
//
//   guards     open    g                        (sliders: none, because an open slider has q = 0)
//              inside  g + (cn/kn) g', -g
//              closed  -N
//              stick   -N, -fs N - T, -fs N + T      F in place of -fs N if friction depends on N
//              slip s  -N, s p'
//                      -N, s T + fs N   for a massless sliding point whose friction rises with the slip rate:
//                                       this guard has the sign of s p'
//   slip rate  p' = ut' + s fk (kn g' + cn g'')/kt   compliant, from T = -s fk N, T' = kt (ut' - p')
//              p' = ut' - s fk q'/kt            slider with kt
//              p' = ut' - s F'/kt               friction that depends on N
//              p' = ut'                         rigid, slider without kt, sliding point of a shear element
//
// Built-in laws: contact/law/coulomb_law.hpp and the normal laws in the same folder. A user-defined law gets
// its rows and guards from data (signorini/user_contact_law.hpp, contact/law/user_law.hpp). All laws implement the interface
// signorini/contact_law.hpp. A guard is positive while its state is valid; the event is the first zero of a guard. Guards
// continue smoothly beyond their zero, so a root finder may evaluate them slightly after the event.
// Source: Lukashevich et al. 2021, (6), (7) and (11), generalised to slip in both directions.
#pragma once

#include "contact/contact_states.hpp"
#include "signorini/contact.hpp"
#include "signorini/user_contact_law.hpp"

namespace signorini::contact {
/// Name of a guard in messages.
[[nodiscard]] const char* to_string(Guard guard);
/// True for the guards of the friction limit.
[[nodiscard]] constexpr bool is_friction_limit(Guard guard) {
  return guard == Guard::slip_plus || guard == Guard::slip_minus || guard == Guard::friction_limit;
}
/// Name of a law as in a scene file: "compliant", "slider".
[[nodiscard]] const char* to_string(Law law);

/// Unit of a form's value, from its nonzero coefficients.
[[nodiscard]] Unit unit_of(const Form& form);

/// Unit of a guard's value.
[[nodiscard]] Unit unit_of(const GuardForm& guard);

/// Rows of a contact in this state, from its law.
[[nodiscard]] Rows rows(const Contact& contact, const ContactState& state);
/// Guards of a contact in this state, from its law. A law has at most ForceLayout::guards() guards; unused entries have the
/// kind Guard::none.
[[nodiscard]] ContactLaw::Guards guards(const Contact& contact, const ContactState& state);
/// Slip rate p' as a form, for a state that slips in direction s = +1 or -1. Unit: length/time.
[[nodiscard]] Form slip_rate(const Contact& contact, int s);

// The next state of a contact after one of its guards has failed.
//
//   guard failed    from     to
//   separation      closed   open (inside while g < 0, which a dashpot makes possible)
//   opening         inside   open
//   closing         open     stick  iff  kt |ut^(m)| <= fs kn |g^(m)|, else slip s = sign ut^(m)
//                            (m: the first derivative of g that is not zero; p := ut, so T = 0)
//   friction limit  stick    slip s,  p := ut - s fk |N| / kt
//   slip rate       slip s   stick,   p := ut - T / kt
//
// Forces and velocities of contacts with springs are continuous, so such a contact is decided alone, from its one-sided
// derivatives. Contacts without tangential stiffness are first decided in the same way; the caller repeats the decision until
// every guard of the new states is positive (decide/contact_state_solver.hpp).
// Source: Lukashevich et al. 2021, section on contact states. The rule for closing compares directions at the apex of the
// friction cone.

/// Slipping state with this sign of the slip rate.
[[nodiscard]] State slip_state(double direction);
/// State of a contact with a compressive force that does not slip: stick if the contact has friction, otherwise closed.
[[nodiscard]] State state_at_rest(const Contact& contact);
/// State of a contact without force: inside if the contact has a dashpot and g < 0, otherwise open.
[[nodiscard]] State separated_state(const Contact& contact, double gap);

/// State after the guard `failed` of state `now` has failed. jet: motion in state `now`, with time derivatives.
[[nodiscard]] ContactState next_state(const Contact& contact, const ContactState& now, Guard failed,
                                      const MotionJet& jet);

/// Violations of (6) and (7) by the motion m; see signorini/contact_work.hpp.
[[nodiscard]] Violations violations(const Contact& contact, State state, const ContactMotion& m);

}  // namespace signorini::contact
