#include "contact/transition.hpp"

namespace signorini {
State slip_along(double direction) { return direction >= 0.0 ? State::slip_plus : State::slip_minus; }

State state_at_rest(const Contact& contact) { return contact.has_friction() ? State::stick : State::closed; }

State let_go(const Contact& contact, double gap) {
  return contact.normal_damping > 0.0 && gap < 0.0 ? State::inside : State::open;
}

ContactState next_state(const Contact& contact, const ContactState& now, Guard failed, const MotionJet& jet) {
  return contact.law->next_state(contact, now, failed, jet);
}

}  // namespace signorini
