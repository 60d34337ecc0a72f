#include "contact/transition.hpp"

#include <cmath>

namespace signorini {
namespace {

State slip(double direction) { return direction >= 0.0 ? State::slip_plus : State::slip_minus; }

/// Closing: the contact enters the friction cone at its apex, so only the directions compare.
ContactState close(const Contact& contact, const MotionJet& jet) {
  ContactState next{State::closed, jet.motion[0].ut};
  if (!contact.has_friction()) return next;
  next.state = State::stick;
  // N jumps and T does not, or the shear element has not yet come to rest: the caller's guards decide.
  if (contact.normal_damping > 0.0 || contact.shear) return next;
  for (std::size_t m = 1; m < jet.motion.size(); ++m) {
    const ContactMotion& d = jet.motion[m];
    const bool normal_moves = std::abs(d.gap) > jet.noise[m].gap;
    const bool tangent_moves = std::abs(d.ut) > jet.noise[m].ut;
    if (!normal_moves && !tangent_moves) continue;
    const double pull = *contact.tangential_stiffness * std::abs(d.ut);
    if (pull > contact.static_friction * contact.normal_stiffness * std::abs(d.gap)) next.state = slip(d.ut);
    break;
  }
  return next;
}

}  // namespace

ContactState next_state(const Contact& contact, const ContactState& now, Guard failed, const MotionJet& jet) {
  const ContactMotion& m = jet.motion[0];
  switch (failed) {
    case Guard::none:
      return now;
    case Guard::separation:
      return {State::open, 0.0, contact.normal_damping > 0.0 && m.gap < 0.0};
    case Guard::clearing:
      return {State::open, 0.0};
    case Guard::closing:
      return close(contact, jet);
    case Guard::slip_plus:
    case Guard::slip_minus: {
      const double s = failed == Guard::slip_plus ? 1.0 : -1.0;
      const double T = -s * contact.kinetic_friction * m.N;
      return {slip(s), contact.tangential_stiffness ? m.ut - T / *contact.tangential_stiffness : m.ut};
    }
    case Guard::sliding:
      return {State::stick, contact.tangential_stiffness ? m.ut - m.T / *contact.tangential_stiffness : m.ut};
  }
  return now;
}

}  // namespace signorini
