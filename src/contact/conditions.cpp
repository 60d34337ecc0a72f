#include "contact/conditions.hpp"

#include <cmath>

#include "contact/friction.hpp"
#include "contact/law.hpp"

namespace signorini {

Violations violations(const Contact& contact, State state, const ContactMotion& m) {
  const bool closed = !is_open(state);
  Violations v;
  if (contact.own) return v;  // it has conditions of its own: its guards
  v.tension = m.N;
  if (contact.has_spring()) {
    // The surface in contact: the element's own length, which a dashpot may leave short (inside).
    const double element = closed ? (m.N - contact.normal_damping * m.vn) / contact.normal_stiffness
                           : state == State::inside ? m.gap
                                                    : 0.0;
    v.gap = -(m.gap - element);
    v.product = std::abs(v.gap * m.N);
  }
  if (contact.takes_impulses()) {
    v.penetration = closed ? std::abs(m.gap) : -m.gap;
    v.product = std::abs(m.gap * m.N);
  }
  const int s = slip_sign(state);
  const double limit = s == 0 || is_held(state) || contact.friction.by_force()
                           ? sticking_limit(contact, m.N)
                           : -sliding_friction(contact, s * m.vt) * m.N;
  if (closed) v.friction = std::abs(m.T) - limit;
  if (s != 0) v.direction = -m.T * slip_rate(contact, s).value(m);
  return v;
}

}  // namespace signorini
