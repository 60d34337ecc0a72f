#include "contact/law.hpp"

#include "base/unit.hpp"

namespace signorini {

const char* to_string(State state) {
  switch (kind_of(state)) {
    case State::open:
    case State::inside:
      return "open";
    case State::closed:
      return "closed";
    case State::stick:
      return "stick";
    case State::slip_plus:
      return "slip+";
    case State::slip_minus:
      return "slip-";
    case State::static_limit_plus:
    case State::static_limit_minus:
      break;  // impossible: kind_of() never returns a static limit
  }
  return "?";
}

}  // namespace signorini

namespace signorini::contact {

const char* to_string(Guard guard) {
  switch (guard) {
    case Guard::none:
      return "none";
    case Guard::closing:
      return "gap";
    case Guard::opening:
      return "open gap";
    case Guard::separation:
      return "compression";
    case Guard::slip_plus:
      return "friction limit (+)";
    case Guard::slip_minus:
      return "friction limit (-)";
    case Guard::friction_limit:
      return "friction limit";
    case Guard::sliding:
      return "slip rate";
    case Guard::user_1:
      return "first guard of its user-defined law";
    case Guard::user_2:
      return "second guard of its user-defined law";
    case Guard::user_3:
      return "third guard of its user-defined law";
  }
  return "?";
}

const char* to_string(Law law) {
  switch (law) {
    case Law::compliant:
      return "compliant";
    case Law::rigid:
      return "rigid";
    case Law::slider:
      return "slider";
  }
  return "?";
}

Unit unit_of(const Form& form) {
  if (form.N != 0.0 || form.T != 0.0 || form.applied_normal_force != 0.0) return unit::force;
  if (form.gap != 0.0 || form.ut != 0.0) return unit::length;
  if (form.vn != 0.0 || form.vt != 0.0) return unit::velocity;
  if (form.applied_normal_force_rate != 0.0) return {1, 0, -1};
  return unit::acceleration;
}

Unit unit_of(const GuardForm& guard) {
  if (guard.is_linear()) return unit_of(guard.form);
  const Unit a = unit_of(guard.products->front().a), b = unit_of(guard.products->front().b);
  return {a.force + b.force, a.length + b.length, a.time + b.time};
}

Rows rows(const Contact& contact, const ContactState& state) { return contact.law->rows(contact, state); }

ContactLaw::Guards guards(const Contact& contact, const ContactState& state) {
  return contact.law->guards(contact, state);
}

Form slip_rate(const Contact& contact, int s) { return contact.law->slip_rate(contact, s); }

State slip_state(double direction) { return direction >= 0.0 ? State::slip_plus : State::slip_minus; }

State state_at_rest(const Contact& contact) { return contact.has_friction() ? State::stick : State::closed; }

State separated_state(const Contact& contact, double gap) {
  return contact.normal_damping > 0.0 && gap < 0.0 ? State::inside : State::open;
}

ContactState next_state(const Contact& contact, const ContactState& now, Guard failed, const MotionJet& jet) {
  return contact.law->next_state(contact, now, failed, jet);
}

Violations violations(const Contact& contact, State state, const ContactMotion& m) {
  return contact.law->violations(contact, state, m);
}

}  // namespace signorini::contact
