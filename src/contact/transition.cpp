#include "contact/transition.hpp"

#include <cmath>

#include "contact/friction.hpp"
#include "contact/motion.hpp"

namespace signorini {
namespace {

/// Closing: the contact enters the friction cone at its apex, so only the directions compare.
ContactState close(const Contact& contact, const MotionJet& jet) {
  ContactState next{state_at_rest(contact), jet.motion[0].ut};
  if (!contact.has_friction()) return next;
  // N jumps and T does not, or the shear element has not yet come to rest: the caller's guards decide.
  if (contact.normal_damping > 0.0 || contact.shear) return next;
  for (std::size_t m = 1; m < jet.motion.size(); ++m) {
    const ContactMotion& d = jet.motion[m];
    const bool normal_moves = std::abs(d.gap) > jet.noise[m].gap;
    const bool tangent_moves = std::abs(d.ut) > jet.noise[m].ut;
    if (!normal_moves && !tangent_moves) continue;
    const double pull = *contact.tangential_stiffness * std::abs(d.ut);
    // At the apex friction that depends on N is that of light loads.
    if (pull > contact.friction.static_ * contact.normal_stiffness * std::abs(d.gap))
      next.state = slip_along(d.ut);
    break;
  }
  return next;
}

}  // namespace

State slip_along(double direction) { return direction >= 0.0 ? State::slip_plus : State::slip_minus; }

State state_at_rest(const Contact& contact) { return contact.has_friction() ? State::stick : State::closed; }

State let_go(const Contact& contact, double gap) {
  return contact.normal_damping > 0.0 && gap < 0.0 ? State::inside : State::open;
}

ContactState state_in(const OwnLaw& law, std::size_t i, double memory) {
  return {own_state(i, law.states[i].kind), memory};
}

ContactState next_state(const Contact& contact, const ContactState& now, Guard failed, const MotionJet& jet) {
  const ContactMotion& m = jet.motion[0];
  const auto next_of_own = [&](std::size_t i) {
    const OwnGuard& guard = contact.own->states[number_of(now.state)].guards[i];
    return state_in(*contact.own, guard.next, guard.memory ? guard.memory->value(m) : now.anchor);
  };
  switch (failed) {
    case Guard::none:
      return now;
    case Guard::separation:
      return {let_go(contact, m.gap), 0.0};
    case Guard::clearing:
      return {State::open, 0.0};
    case Guard::closing:
      return close(contact, jet);
    case Guard::slip_plus:
    case Guard::slip_minus: {
      const double s = failed == Guard::slip_plus ? 1.0 : -1.0;
      const double T = s * sliding_limit(contact, m.N);
      return {slip_along(s), slip_of(contact, m.ut, T)};
    }
    case Guard::sliding:
      return {State::stick, slip_of(contact, m)};
    case Guard::own_1:
      return next_of_own(0);
    case Guard::own_2:
      return next_of_own(1);
    case Guard::own_3:
      return next_of_own(2);
  }
  return now;
}

}  // namespace signorini
