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

#include <array>
#include <memory>
#include <vector>

#include "contact/contact_states.hpp"
#include "signorini/contact.hpp"
#include "signorini/user_contact_law.hpp"

namespace signorini {

/// Guards, named after the change of state at the zero of the guard. closing: g of an open contact; opening: -g in state
/// inside; separation: -N; slip_plus, slip_minus: distance of T from the friction limit in the direction + or -; sliding: the
/// slip rate; user_1 to user_3: the guards of a user law; none: an unused entry.
enum class Guard : unsigned char {
  none,
  closing,
  opening,
  separation,
  slip_plus,
  slip_minus,
  sliding,
  user_1,
  user_2,
  user_3
};

}  // namespace signorini

namespace signorini::contact {
/// Name of a guard in messages.
[[nodiscard]] const char* to_string(Guard guard);
/// True for the guards of the friction limit.
[[nodiscard]] constexpr bool is_friction_limit(Guard guard) {
  return guard == Guard::slip_plus || guard == Guard::slip_minus;
}
/// Name of a law as in a scene file: "compliant", "slider".
[[nodiscard]] const char* to_string(Law law);

/// Unit of a form's value, from its nonzero coefficients.
[[nodiscard]] Unit unit_of(const Form& form);

}  // namespace signorini::contact

namespace signorini {

/// A guard G = form + sum of products a b. Engines and decisions evaluate guards only with these functions. motion[k] is the
/// k-th time derivative of the motion; noise[k] contains the magnitudes below which entries of motion[k] are treated as zero.
struct GuardForm {
  Guard kind = Guard::none;
  Form form;
  /// Products a b; nullptr: the guard has no products and is linear.
  std::shared_ptr<const std::vector<FormProduct>> products = nullptr;

  [[nodiscard]] bool is_linear() const { return products == nullptr; }
  [[nodiscard]] double value(const ContactMotion& m) const {
    return is_linear() ? form.value(m) : form.value(m) + derivative_of_products(&m, 0);
  }
  /// Time derivative G^(k).
  [[nodiscard]] double derivative(const ContactMotion* motion, std::size_t k) const {
    const double d = k == 0 ? form.value(motion[0]) : form.rate(motion[k]);
    return is_linear() ? d : d + derivative_of_products(motion, k);
  }
  /// Bound of the rounding error of G^(k).
  [[nodiscard]] double rounding(const ContactMotion* motion, const ContactMotion* noise,
                                std::size_t k) const {
    const double r = form.magnitude(noise[k]);
    return is_linear() ? r : r + rounding_of_products(motion, noise, k);
  }
  /// Derivative of G with respect to a parameter, from the motion m and its derivative `by` with respect to the parameter.
  [[nodiscard]] double parameter_derivative(const ContactMotion& m, const ContactMotion& by) const;

  [[nodiscard]] bool operator==(const GuardForm& other) const;

 private:
  [[nodiscard]] double derivative_of_products(const ContactMotion* motion, std::size_t k) const;
  [[nodiscard]] double rounding_of_products(const ContactMotion* motion, const ContactMotion* noise,
                                            std::size_t k) const;
};

}  // namespace signorini

namespace signorini::contact {

/// Unit of a guard's value.
[[nodiscard]] Unit unit_of(const GuardForm& guard);

}  // namespace signorini::contact

namespace signorini {

/// The two constraint rows of a contact: forms that are zero for the motion of the contact.
struct Rows {
  Form normal, tangent;
};

}  // namespace signorini

namespace signorini::contact {

/// Rows of a contact in this state, from its law.
[[nodiscard]] Rows rows(const Contact& contact, const ContactState& state);
/// Guards of a contact in this state, from its law. A law has at most ForceLayout::guards() guards; unused entries have the
/// kind Guard::none.
[[nodiscard]] ContactLaw::Guards guards(const Contact& contact, const ContactState& state);
/// Slip rate p' as a form, for a state that slips in direction s = +1 or -1. Unit: length/time.
[[nodiscard]] Form slip_rate(const Contact& contact, int s);

}  // namespace signorini::contact

namespace signorini {

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

/// Motion of one contact just after an instant: motion[k] is the k-th time derivative. noise[k]: for each entry of motion[k],
/// the error caused by one rounding of the data.
struct MotionJet {
  static constexpr std::size_t orders = 5;  ///< the motion and its first four derivatives
  std::array<ContactMotion, orders> motion, noise;
};

}  // namespace signorini

namespace signorini::contact {

/// Slipping state with this sign of the slip rate.
[[nodiscard]] State slip_state(double direction);
/// State of a contact with a compressive force that does not slip: stick if the contact has friction, otherwise closed.
[[nodiscard]] State state_at_rest(const Contact& contact);
/// State of a contact without force: inside if the contact has a dashpot and g < 0, otherwise open.
[[nodiscard]] State separated_state(const Contact& contact, double gap);

/// State after the guard `failed` of state `now` has failed. jet: motion in state `now`, with time derivatives.
[[nodiscard]] ContactState next_state(const Contact& contact, const ContactState& now, Guard failed,
                                      const MotionJet& jet);

}  // namespace signorini::contact

namespace signorini {

// Amounts by which a contact violates its conditions (6) and (7).
//
//   (6)  g >= 0, N <= 0, g N = 0          with a normal spring, g is reduced by its deformation (N - cn g')/kn
//   (7)  |T| <= T_U, T p' >= 0            T_U: static limit in stick, friction at the slip rate in slip

/// Amounts of violation; a value is positive if its condition is violated.
struct Violations {
  double tension = 0.0;  ///< N; positive in tension; force
  double gap = 0.0;      ///< -(g - deformation of the spring); length; only for contacts with a normal spring
  double penetration = 0.0;  ///< |g| if closed, -g if open; length; only for rigid contacts
  double product = 0.0;      ///< |g N|, with g as in `gap` or `penetration`; energy
  double friction = 0.0;     ///< |T| - T_U of a closed contact; force
  double direction = 0.0;    ///< -T p' of a slipping contact; power
};

}  // namespace signorini

namespace signorini::contact {

[[nodiscard]] Violations violations(const Contact& contact, State state, const ContactMotion& m);

}  // namespace signorini::contact
