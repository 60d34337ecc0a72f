#include "contact/law.hpp"

#include "contact/friction.hpp"

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
    case State::held_plus:
    case State::held_minus:
      break;  // kinds they are not
  }
  return "?";
}

const char* to_string(Guard guard) {
  switch (guard) {
    case Guard::none:
      return "none";
    case Guard::closing:
      return "gap";
    case Guard::clearing:
      return "open gap";
    case Guard::separation:
      return "compression";
    case Guard::slip_plus:
      return "friction limit (+)";
    case Guard::slip_minus:
      return "friction limit (-)";
    case Guard::sliding:
      return "slip rate";
    case Guard::own_1:
      return "first guard of its own law";
    case Guard::own_2:
      return "second guard of its own law";
    case Guard::own_3:
      return "third guard of its own law";
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

std::string law_name(const Contact& contact) {
  if (contact.own && !contact.own->name.empty()) return contact.own->name;
  return to_string(contact.borrows ? Law::rigid : contact.law);
}

int slip_sign(State state) {
  const State kind = kind_of(state);
  return kind == State::slip_plus ? 1 : kind == State::slip_minus ? -1 : 0;
}

namespace {

const OwnState& state_in(const Contact& contact, const ContactState& state) {
  return contact.own->states[is_own(state.state) ? number_of(state.state) : 0];
}

Form with_memory(const OwnForm& own, double memory) {
  Form form = own.form;
  form.constant += own.memory * memory;
  return form;
}

}  // namespace

Form slip_rate(const Contact& contact, int s) {
  Form form;
  form.vt = 1.0;
  if (!contact.tangential_stiffness || contact.own) return form;
  if (contact.friction.by_force()) {
    form.limit_rate = -s / *contact.tangential_stiffness;
    return form;
  }
  const double ratio = s * kinetic_friction(contact) / *contact.tangential_stiffness;
  if (contact.has_spring()) {
    form.vn = ratio * contact.normal_stiffness;
    form.an = ratio * contact.normal_damping;
  } else {
    form.pressing_rate = -ratio;
  }
  return form;
}

Rows rows(const Contact& contact, const ContactState& state) {
  if (contact.own) {
    const OwnState& own = state_in(contact, state);
    return {with_memory(own.normal, state.anchor), with_memory(own.tangent, state.anchor)};
  }
  Rows result;
  result.normal.N = 1.0;
  result.tangent.T = 1.0;
  if (contact.is_pressed()) {
    result.normal.pressing = 1.0;
  } else if (!state.is_open() && contact.takes_impulses()) {
    result.normal.N = 0.0;
    result.normal.an = 1.0;
  } else if (!state.is_open()) {
    result.normal.gap = -contact.normal_stiffness;
    result.normal.vn = -contact.normal_damping;
  }

  switch (state.state) {
    case State::open:
    case State::inside:
    case State::closed:
      break;
    case State::stick:
      if (contact.tangential_stiffness) {
        result.tangent.ut = -*contact.tangential_stiffness;
        result.tangent.constant = *contact.tangential_stiffness * state.anchor;
      } else {
        result.tangent.T = 0.0;
        (contact.shear ? result.tangent.vt : result.tangent.at) = 1.0;
      }
      break;
    case State::slip_plus:
    case State::slip_minus:
    case State::held_plus:
    case State::held_minus:
      if (contact.friction.by_force())
        result.tangent.limit = -slip_sign(state.state);
      else
        result.tangent = sliding_row(slip_sign(state.state), slipping_friction(contact, state.state));
      break;
  }
  return result;
}

namespace {

/// How far T is from the limit of friction on one side.
Form friction_left(const Contact& contact, double side) {
  Form form;
  form.T = -side;
  if (contact.friction.by_force())
    form.limit = 1.0;
  else
    form.N = -static_friction(contact);
  return form;
}

}  // namespace

std::array<GuardForm, guards_per_contact> guards(const Contact& contact, const ContactState& state) {
  std::array<GuardForm, guards_per_contact> result;
  if (contact.own) {
    constexpr std::array kinds = {Guard::own_1, Guard::own_2, Guard::own_3};
    const OwnState& own = state_in(contact, state);
    for (std::size_t i = 0; i < own.guards.size(); ++i)
      result[i] = {kinds[i], with_memory(own.guards[i].positive, state.anchor)};
    return result;
  }
  const bool slider = contact.is_pressed();
  if (state.is_open()) {
    if (!slider) {
      result[0].kind = Guard::closing;
      result[0].form.gap = 1.0;
    }
    if (state.state == State::inside) {
      result[0].form.vn = contact.normal_damping / contact.normal_stiffness;
      result[1].kind = Guard::clearing;
      result[1].form.gap = -1.0;
    }
    return result;
  }
  if (!slider) {
    result[0].kind = Guard::separation;
    result[0].form.N = -1.0;
  }
  if (state.state == State::stick) {
    result[1].kind = Guard::slip_plus;
    result[1].form = friction_left(contact, 1.0);
    result[2].kind = Guard::slip_minus;
    result[2].form = friction_left(contact, -1.0);
  } else if (const int s = slip_sign(state.state); s != 0) {
    result[1].kind = Guard::sliding;
    result[1].form = s > 0 ? slip_rate(contact, s) : -slip_rate(contact, s);
    if (contact.shear && contact.friction.rises()) {  // it tells the rate, and is known better
      result[1].form = {};
      result[1].form.N = static_friction(contact);
      result[1].form.T = s;
    }
  }
  return result;
}

}  // namespace signorini
