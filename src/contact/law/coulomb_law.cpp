#include "contact/law/coulomb_law.hpp"

#include <cmath>

#include "contact/friction.hpp"
#include "contact/law.hpp"
#include "contact/motion.hpp"
#include "contact/work.hpp"

namespace signorini {
namespace {

/// Distance of T from the friction limit in direction `side` (+1 or -1), as a form.
Form friction_margin(const Contact& contact, double side) {
  Form form;
  form.T = -side;
  if (contact.friction.is_load_dependent())
    form.limit = 1.0;
  else
    form.N = -contact::static_friction(contact);
  return form;
}

Form tangent_row(const Contact& contact, const ContactState& state) {
  Form row;
  row.T = 1.0;
  if (state.state == State::stick) {
    if (contact.tangential_stiffness) {
      row.ut = -*contact.tangential_stiffness;
      row.constant = *contact.tangential_stiffness * state.anchor;
    } else {
      row.T = 0.0;
      (contact.shear ? row.vt : row.at) = 1.0;
    }
  } else if (const int s = slip_sign(state.state); s != 0) {
    if (contact.friction.is_load_dependent())
      row.limit = -s;
    else
      row = contact::sliding_row(s, contact::slipping_friction(contact, state.state));
  }
  return row;
}

/// State after closing. The contact enters the friction cone at its apex, so only directions of the motion are compared.
ContactState close(const Contact& contact, const MotionJet& jet) {
  ContactState next{contact::state_at_rest(contact), jet.motion[0].ut};
  if (!contact.has_friction()) return next;
  // If N jumps but T does not, or if the shear element still moves, the caller checks the friction limits in stick.
  if (contact.normal_damping > 0.0 || contact.shear) return next;
  for (std::size_t m = 1; m < jet.motion.size(); ++m) {
    const ContactMotion& d = jet.motion[m];
    const bool normal_moves = std::abs(d.gap) > jet.noise[m].gap;
    const bool tangent_moves = std::abs(d.ut) > jet.noise[m].ut;
    if (!normal_moves && !tangent_moves) continue;
    const double pull = *contact.tangential_stiffness * std::abs(d.ut);
    // At the apex N is zero, so the coefficient is static_, also for friction that depends on N.
    if (pull > contact.friction.static_ * contact.normal_stiffness * std::abs(d.gap))
      next.state = contact::slip_state(d.ut);
    break;
  }
  return next;
}

/// Direction, +1 or -1, of the friction force just after an instant.
double direction_of_friction(const MotionJet& jet) {
  for (std::size_t k = 0; k < jet.motion.size(); ++k)
    if (const double T = jet.motion[k].T; std::abs(T) > jet.noise[k].T) return T > 0.0 ? 1.0 : -1.0;
  return 1.0;  // no friction force: a guard of the friction limit cannot fail
}

}  // namespace

Form CoulombLaw::slip_rate(const Contact& contact, int s) const {
  Form form;
  form.vt = 1.0;
  if (!contact.tangential_stiffness) return form;
  if (contact.friction.is_load_dependent())
    form.limit_rate = -s / *contact.tangential_stiffness;
  else
    add_normal_rate(contact, s * contact::kinetic_friction(contact) / *contact.tangential_stiffness, form);
  return form;
}

Rows CoulombLaw::rows(const Contact& contact, const ContactState& state) const {
  Rows result;
  if (state.is_open() && !capabilities.normal_force_given)
    result.normal.N = 1.0;
  else
    result.normal = closed_normal_row(contact);
  result.tangent = tangent_row(contact, state);
  return result;
}

void CoulombLaw::set_normal_guards(const Contact& contact, const ContactState& state, Guards& result) const {
  if (!state.is_open()) {
    result[0].kind = Guard::separation;
    result[0].form.N = -1.0;
    return;
  }
  result[0].kind = Guard::closing;
  result[0].form.gap = 1.0;
  if (state.state != State::inside) return;
  result[0].form.vn = contact.normal_damping / contact.normal_stiffness;
  result[1].kind = Guard::opening;
  result[1].form.gap = -1.0;
}

ContactLaw::Guards CoulombLaw::guards(const Contact& contact, const ContactState& state) const {
  Guards result;
  set_normal_guards(contact, state, result);
  if (state.state == State::stick) {
    result[1].kind = Guard::slip_plus;
    result[1].form = friction_margin(contact, 1.0);
    result[2].kind = Guard::slip_minus;
    result[2].form = friction_margin(contact, -1.0);
  } else if (const int s = slip_sign(state.state); s != 0) {
    result[1].kind = Guard::sliding;
    result[1].form = s > 0 ? slip_rate(contact, s) : -slip_rate(contact, s);
    if (contact.shear && contact.friction.is_rate_strengthening()) {  // same sign as s p', but more accurate
      result[1].form = {};
      result[1].form.N = contact::static_friction(contact);
      result[1].form.T = s;
    }
  }
  return result;
}

ContactState CoulombLaw::next_state(const Contact& contact, const ContactState& now, Guard failed,
                                    const MotionJet& jet) const {
  const ContactMotion& m = jet.motion[0];
  switch (failed) {
    case Guard::separation:
      return {contact::separated_state(contact, m.gap), 0.0};
    case Guard::opening:
      return {State::open, 0.0};
    case Guard::closing:
      return close(contact, jet);
    case Guard::slip_plus:
    case Guard::slip_minus:
    case Guard::friction_limit: {
      const double s = failed == Guard::friction_limit ? direction_of_friction(jet)
                       : failed == Guard::slip_plus    ? 1.0
                                                       : -1.0;
      const double T = s * contact::sliding_limit(contact, m.N);
      return {contact::slip_state(s), contact::slip_of(contact, m.ut, T)};
    }
    case Guard::sliding:
      return {State::stick, contact::slip_of(contact, m)};
    case Guard::none:
    case Guard::user_1:
    case Guard::user_2:
    case Guard::user_3:
      break;
  }
  return now;
}

std::vector<ContactState> CoulombLaw::candidates(const Contact& contact, const ContactState& now,
                                                 const ContactMotion& before) const {
  // A sticking contact keeps its anchor; any other contact would stick at its present position.
  const double anchor = now.state == State::stick ? now.anchor : contact::slip_of(contact, before);
  std::vector<ContactState> result;
  if (!capabilities.normal_force_given)
    result.push_back({contact::separated_state(contact, before.gap), 0.0});
  if (!contact.has_friction()) {
    result.push_back({State::closed, 0.0});
    return result;
  }
  for (const State s : {State::stick, State::slip_plus, State::slip_minus}) result.push_back({s, anchor});
  return result;
}

double CoulombLaw::working_slip_rate(const Contact& contact, State state, const ContactMotion& m) const {
  const int s = slip_sign(state);
  return s == 0 ? 0.0 : slip_rate(contact, s).value(m);
}

ContactWork CoulombLaw::work(const Contact& contact, State state, double N, double T,
                             const ContactIncrement& path) const {
  return contact::coulomb_work(contact, state, N, T, path);
}

double CoulombLaw::normal_energy(const Contact& /*contact*/, State /*state*/,
                                 const ContactMotion& /*m*/) const {
  return 0.0;
}

double CoulombLaw::stored_energy(const Contact& contact, State state, const ContactMotion& m) const {
  return contact::shear_energy(contact, m.T) + normal_energy(contact, state, m);
}

Violations CoulombLaw::violations(const Contact& contact, State state, const ContactMotion& m) const {
  Violations v;
  v.tension = m.N;
  const int s = slip_sign(state);
  const double limit = s == 0 || is_at_static_limit(state) || contact.friction.is_load_dependent()
                           ? contact::sticking_limit(contact, m.N)
                           : -contact::sliding_friction(contact, s * m.vt) * m.N;
  if (!is_open(state)) v.friction = std::abs(m.T) - limit;
  if (s != 0) v.direction = -m.T * slip_rate(contact, s).value(m);
  return v;
}

}  // namespace signorini
