// law.hpp: rows and guards of a contact in each of its states.
//
//   law        open            closed, stick, slip: normal   stick                        slip s
//   compliant  N = 0, T = 0    N - kn g = 0                  T - kt (ut - p) = 0          T + s fk N = 0
//   rigid      N = 0, T = 0    g'' = 0                       ut'' = 0                     T + s fk N = 0
//   slider     N + q = 0       N + q = 0                     the same, or ut'' = 0        T + s fk N = 0
//   with a shear element, whose sliding point is massless:   p' = 0                       T + s fk N = 0
//   held s, at rest at the static limit because other contacts prevent its motion:   T + s fs N = 0
//   Friction that depends on N has the row T - s F = 0, F(|N|): contact/friction_limit.hpp.
//   A dashpot adds cn g' to kn g. The contact still opens at N = 0, so it never pulls; g is negative then,
//   and it stays open until kn g + cn g' < 0 again or the gap has opened (state "inside").
//
//   guards     open    g                        (sliders: none; q = 0 there)
//              inside  g + (cn/kn) g', -g
//              closed  -N
//              stick   -N, -fs N - T, -fs N + T      F in place of -fs N where friction depends on N
//              slip s  -N, s p'
//                      -N, s T + fs N   if the friction of a massless sliding point rises: same sign as s p'
//   slip rate  p' = ut' + s fk (kn g' + cn g'')/kt   compliant, from T = -s fk N, T' = kt (ut' - p')
//              p' = ut' - s fk q'/kt            slider with kt
//              p' = ut' - s F'/kt               friction that depends on N
//              p' = ut'                         rigid, slider without kt, sliding point of a shear element
//
// These are the built-in laws: contact/law/coulomb_law.hpp and the laws along the normal in the same folder. A
// user-defined law has the rows and guards that its data give (signorini/own_law.hpp, contact/law/user_law.hpp). All
// laws share the interface signorini/contact_law.hpp. A guard is positive while its state is valid; the event is the
// first zero of a guard. Guards are smooth past their zero, so that a root finder may evaluate them slightly beyond the
// event.
// Source: Lukashevich et al. 2021, (6), (7) and (11), generalised to slip in both directions.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "contact/slots.hpp"
#include "signorini/contact.hpp"
#include "signorini/own_law.hpp"

namespace signorini {

/// Meaning of a guard.
enum class Guard : unsigned char {
  none,
  closing,
  clearing,
  separation,
  slip_plus,
  slip_minus,
  sliding,
  own_1,
  own_2,
  own_3
};
[[nodiscard]] const char* to_string(Guard guard);
/// True for a guard of the friction limit, on either side.
[[nodiscard]] constexpr bool is_friction_limit(Guard guard) {
  return guard == Guard::slip_plus || guard == Guard::slip_minus;
}
/// Name of a law as in a scene file: "compliant", "slider".
[[nodiscard]] const char* to_string(Law law);

/// Unit of a form's value, derived from its first term.
[[nodiscard]] Unit unit_of(const Form& form);

/// G = form + sum a b over its products; engines and decisions evaluate guards only through these functions. Motions
/// are given as time derivatives 0, 1, ..., and so are the sizes that count as zero in them.
struct GuardForm {
  Guard kind = Guard::none;
  Form form;
  std::shared_ptr<const std::vector<FormProduct>> products = nullptr;  ///< nullptr for a linear guard

  [[nodiscard]] bool is_linear() const { return products == nullptr; }
  [[nodiscard]] double value(const ContactMotion& m) const {
    return is_linear() ? form.value(m) : form.value(m) + derivative_of_products(&m, 0);
  }
  /// Time derivative G^(k).
  [[nodiscard]] double derivative(const ContactMotion* motion, std::size_t k) const {
    const double d = k == 0 ? form.value(motion[0]) : form.rate(motion[k]);
    return is_linear() ? d : d + derivative_of_products(motion, k);
  }
  /// Rounding error of G^(k).
  [[nodiscard]] double rounding(const ContactMotion* motion, const ContactMotion* noise,
                                std::size_t k) const {
    const double r = form.magnitude(noise[k]);
    return is_linear() ? r : r + rounding_of_products(motion, noise, k);
  }
  /// Derivative of G with respect to a parameter, from the derivative of the motion.
  [[nodiscard]] double change(const ContactMotion& m, const ContactMotion& by) const;

  [[nodiscard]] bool operator==(const GuardForm& other) const;

 private:
  [[nodiscard]] double derivative_of_products(const ContactMotion* motion, std::size_t k) const;
  [[nodiscard]] double rounding_of_products(const ContactMotion* motion, const ContactMotion* noise,
                                            std::size_t k) const;
};

/// Unit of a guard's value.
[[nodiscard]] Unit unit_of(const GuardForm& guard);

/// The two rows (residuals) of a contact.
struct Rows {
  Form normal, tangent;
};

[[nodiscard]] Rows rows(const Contact& contact, const ContactState& state);
[[nodiscard]] std::array<GuardForm, guards_per_contact> guards(const Contact& contact,
                                                               const ContactState& state);
/// p' as a form, for a state that slips in direction s = +1 or -1. Unit: length/time.
[[nodiscard]] Form slip_rate(const Contact& contact, int s);

}  // namespace signorini
