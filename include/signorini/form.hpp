// form.hpp: contact states, the motion of a contact, and linear forms on that motion.
//
//   value = c + a_N N + a_T T + a_g g + a_ut ut + a_vn g' + a_vt ut' + a_an g'' + a_at ut''
//             + a_q q + a_q' q' + a_F F + a_F' F'        q = normal_force(t), F = f(|N|) |N|
//
// Residual rows (value = 0) and guards (value > 0) are such forms. So a contact law is data for an engine, and the time
// derivatives of rows and guards follow from the derivatives of the motion. F is the limit of the friction force if the
// coefficient depends on N. F is the only term that is not linear in the motion; it is computed with the motion of the contact
// (contact/friction.hpp).
#pragma once

#include <cmath>
#include <cstddef>

namespace signorini {

/// inside: no contact force although g < 0, because a dashpot released the contact before the gap opened. static_limit_plus,
/// static_limit_minus: friction is at its static limit, but other sticking contacts prevent slip; kind_of() treats these two
/// states as slip_plus and slip_minus.
enum class State : unsigned char {
  open,
  inside,
  closed,
  stick,
  slip_plus,
  slip_minus,
  static_limit_plus,
  static_limit_minus
};

inline constexpr std::size_t max_user_law_states = 31;
/// State i of a user law (user_contact_law.hpp), 0 <= i < max_user_law_states. `kind` is the built-in state that
/// replaces the user state where only built-in states are known, for example in files. The result differs from every
/// built-in state.
[[nodiscard]] constexpr State user_law_state(std::size_t i, State kind) {
  return static_cast<State>(8U * (i + 1) + static_cast<unsigned>(kind));
}
[[nodiscard]] constexpr bool is_user_law_state(State state) { return static_cast<unsigned>(state) >= 8U; }
/// Inverse of user_law_state(): the number of the state in its law.
[[nodiscard]] constexpr std::size_t user_law_state_number(State own) {
  return static_cast<unsigned>(own) / 8U - 1U;
}
/// Kind of any state: for a state of a user law the kind given by the law, for a static limit the slip in its direction, for
/// any other state the state itself.
[[nodiscard]] constexpr State kind_of(State state) {
  const unsigned kind = static_cast<unsigned>(state) % 8U;
  return static_cast<State>(kind < 6U ? kind : kind - 2U);
}
/// True if friction is at the static limit and the contact does not slip.
[[nodiscard]] constexpr bool is_at_static_limit(State state) {
  return state == State::static_limit_plus || state == State::static_limit_minus;
}

/// Name of the kind: "open" (also for inside), "closed", "stick", "slip+", "slip-".
[[nodiscard]] const char* to_string(State state);
/// True if the state transmits no force.
[[nodiscard]] constexpr bool is_open(State state) {
  return kind_of(state) == State::open || state == State::inside;
}
/// Direction of slip: +1, -1; 0 if the contact does not slip.
[[nodiscard]] constexpr int slip_sign(State state) {
  const State kind = kind_of(state);
  return kind == State::slip_plus ? 1 : kind == State::slip_minus ? -1 : 0;
}

/// Forces and motion of one contact at one instant, or a time derivative of them.
struct ContactMotion {
  double N = 0.0, T = 0.0;     ///< force
  double gap = 0.0, ut = 0.0;  ///< length; ut relative to the surface
  double vn = 0.0, vt = 0.0;   ///< g', ut'
  double an = 0.0, at = 0.0;   ///< g'', ut''
  double applied_normal_force = 0.0,
         applied_normal_force_rate = 0.0;  ///< normal_force(t) and its rate; sliders
  double limit = 0.0, limit_rate = 0.0;    ///< F and its rate; nonzero only for friction that depends on N
};

struct Form {
  double N = 0.0, T = 0.0, gap = 0.0, ut = 0.0, vn = 0.0, vt = 0.0, an = 0.0, at = 0.0;
  double applied_normal_force = 0.0, applied_normal_force_rate = 0.0;
  double limit = 0.0, limit_rate = 0.0;
  double constant = 0.0;

  /// Value of the form without its constant, for use with a time derivative of the motion.
  [[nodiscard]] double rate(const ContactMotion& m) const {
    return N * m.N + T * m.T + gap * m.gap + ut * m.ut + vn * m.vn + vt * m.vt + an * m.an + at * m.at +
           applied_normal_force * m.applied_normal_force +
           applied_normal_force_rate * m.applied_normal_force_rate + limit * m.limit +
           limit_rate * m.limit_rate;
  }
  [[nodiscard]] double value(const ContactMotion& m) const { return constant + rate(m); }
  /// Sum of the magnitudes of the terms; m contains magnitudes.
  [[nodiscard]] double magnitude(const ContactMotion& m) const {
    return std::abs(N * m.N) + std::abs(T * m.T) + std::abs(gap * m.gap) + std::abs(ut * m.ut) +
           std::abs(vn * m.vn) + std::abs(vt * m.vt) + std::abs(an * m.an) + std::abs(at * m.at) +
           std::abs(applied_normal_force * m.applied_normal_force) +
           std::abs(applied_normal_force_rate * m.applied_normal_force_rate) + std::abs(limit * m.limit) +
           std::abs(limit_rate * m.limit_rate);
  }
  [[nodiscard]] bool operator==(const Form&) const = default;
  [[nodiscard]] Form operator-() const {
    return {-N,
            -T,
            -gap,
            -ut,
            -vn,
            -vt,
            -an,
            -at,
            -applied_normal_force,
            -applied_normal_force_rate,
            -limit,
            -limit_rate,
            -constant};
  }
};

/// The two residual rows of a contact: forms that are zero for the motion of the contact.
struct Rows {
  Form normal, tangent;
};

/// The product of two forms; each form includes its constant.
struct FormProduct {
  Form a, b;
  [[nodiscard]] bool operator==(const FormProduct&) const = default;
};

}  // namespace signorini
