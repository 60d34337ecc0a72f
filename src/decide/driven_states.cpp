// States that follow from displacements, velocities and the forcing alone: at the start, and where the
// forcing is not smooth.
#include <algorithm>
#include <cmath>
#include <limits>

#include "decide/decide.hpp"

namespace signorini {
namespace {

constexpr double same_speed = 1e-12;  // of two pieces of a history where they meet smoothly

/// The state that a contact which bears a load takes up at rest relative to its surface.
State at_rest(const Contact& contact) { return contact.has_friction() ? State::stick : State::closed; }

}  // namespace

Mode first_mode(const Model& model, const Forcing& forcing, double t, const Vector& u, const Vector& v) {
  Mode mode;
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const Contact& contact = model.contacts[c];
    ContactState s;
    const double ut = contact.tangent.dot(u) - forcing.surface(c, t, 0);
    // A rigid contact that touches is decided together with the others.
    const bool carries = contact.law == Law::slider      ? !forcing.lifted(c)
                         : contact.law == Law::compliant ? contact.gap + contact.normal.dot(u) < 0.0
                                                         : false;
    if (carries) {
      s.state = at_rest(contact);
      if (contact.tangential_stiffness) {
        s.anchor = ut - contact.initial_shear / *contact.tangential_stiffness;
      } else if (contact.has_friction() && !contact.shear) {
        const double vt = contact.tangent.dot(v) - forcing.surface(c, t, 1);
        double size = std::abs(forcing.surface(c, t, 1));
        for (const auto& [dof, factor] : contact.tangent.terms) size += std::abs(factor * v[dof]);
        if (std::abs(vt) >
            8.0 * std::numeric_limits<double>::epsilon() * size + forcing.surface_rounding(c, t))
          s.state = vt > 0.0 ? State::slip_plus : State::slip_minus;
      }
    }
    mode.push_back(s);
  }
  return mode;
}

void Decider::follow_forcing(const Instant& instant, const Forcing& before, const Forcing& after,
                             const std::vector<ContactMotion>& motion, Mode& mode) const {
  const double t = instant.t;
  for (std::size_t c = 0; c < mode.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    ContactState& s = mode[c];
    const bool massless = std::any_of(
        contact.tangent.terms.begin(), contact.tangent.terms.end(),
        [&](const auto& term) { return model_.dofs[static_cast<std::size_t>(term.first)].massless; });
    // Where ut itself may jump, the slip of that instant is found as in statics: from the anchor that the
    // motion before has left, elastic first, then slip in the direction in which the limit is exceeded.
    if (massless && slip_sign(s.state) != 0 && contact.tangential_stiffness)
      s = {State::stick, motion[c].ut - motion[c].T / *contact.tangential_stiffness};
    if (contact.law == Law::compliant || (contact.law == Law::rigid && s.state == State::open)) continue;
    const double ut = contact.tangent.dot(instant.u) - after.surface(c, t, 0);
    const double vt = contact.tangent.dot(instant.v) - after.surface(c, t, 1);
    if (after.lifted(c)) {
      s = {State::open, 0.0};
      continue;
    }
    // Smooth tables meet to the rounding of their pieces: no jump.
    const double speed = std::abs(after.surface(c, t, 1)) + std::abs(before.surface(c, t, 1));
    double surface_jump = after.surface(c, t, 1) - before.surface(c, t, 1);
    if (std::abs(surface_jump) <= same_speed * (speed + model_.scales.velocity)) surface_jump = 0.0;
    const bool moves = std::abs(vt) > 64.0 * std::numeric_limits<double>::epsilon() *
                                              (std::abs(after.surface(c, t, 1)) + std::abs(surface_jump)) +
                                          after.surface_rounding(c, t);
    if (s.state == State::open) {
      s = {at_rest(contact), ut};
      if (contact.has_friction() && !contact.tangential_stiffness && moves)
        s.state = vt > 0.0 ? State::slip_plus : State::slip_minus;
      continue;
    }
    const int sign = slip_sign(s.state);
    if (contact.tangential_stiffness) {
      // T is continuous when the compression jumps up: below its new limit the contact sticks.
      if (sign != 0 && after.pressing(c, t, 0) > before.pressing(c, t, 0))
        s = {State::stick, ut - motion[c].T / *contact.tangential_stiffness};
    } else if (contact.has_friction() && surface_jump != 0.0 && moves) {
      s.state = vt > 0.0 ? State::slip_plus : State::slip_minus;
    }
  }
}

}  // namespace signorini
