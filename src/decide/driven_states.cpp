#include "decide/driven_states.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "contact/motion.hpp"

namespace signorini::decide {
namespace {

constexpr double same_value = 1e-12;  // relative difference up to which values of two pieces are equal

/// Magnitude of the terms of a form of x, to which the rounding error of its value is proportional. Each translation is
/// replaced by the largest translation in x, but at least `own`; each rotation by the largest rotation, but at least
/// `min_rotation`, because states that are read from a file have this accuracy.
double rounding_scale(const Model& model, const Combination& form, const Vector& x, double own,
                      double min_rotation) {
  double greatest[2] = {own, min_rotation}, sum = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    double& most = greatest[model.dofs[static_cast<std::size_t>(i)].rotation ? 1 : 0];
    most = std::max(most, std::abs(x[i]));
  }
  for (const auto& [dof, factor] : form.terms)
    sum += std::abs(factor) * greatest[model.dofs[static_cast<std::size_t>(dof)].rotation ? 1 : 0];
  return sum;
}

}  // namespace

std::vector<TriggeredGuard> guards_zero_at_start(const Model& model, const Vector& u, const Vector& v,
                                                 const contact::ContactStates& states) {
  std::vector<TriggeredGuard> result;
  for (std::size_t c = 0; c < model.saved_contacts.size(); ++c) {
    const Contact& contact = model.contacts[c];
    if (!contact.is_elastic_along_normal() || contact.compliance_split()) continue;
    const bool was_open = model.saved_contacts[c].state == to_string(State::open),
               is_now = states[c].is_open();
    if (was_open == is_now) continue;
    const double kn = contact.normal_stiffness, cn = contact.normal_damping, gap = contact.gap_at(u);
    const Scales& scales = model.scales;
    const double gap_terms = std::abs(contact.gap) +
                             rounding_scale(model, contact.normal, u, scales.displacement, scales.rotation);
    const double rate_terms =
        rounding_scale(model, contact.normal, v, scales.velocity, scales.angular_velocity);
    // The contact closes at g = 0, and opens at N = kn g + cn g' = 0.
    const double off = was_open ? kn * gap + cn * contact::gap_rate(contact, v) : kn * gap;
    const double zero = rounding::many_operations * kn * gap_terms +
                        (was_open ? rounding::many_operations * cn * rate_terms : 0.0);
    if (std::abs(off) <= zero) result.push_back({c, was_open ? Guard::separation : Guard::closing});
  }
  return result;
}

contact::ContactStates initial_states(const Model& model, const motion::Forcing& forcing, double t,
                                      const Vector& u, const Vector& v) {
  contact::ContactStates states;
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const Contact& contact = model.contacts[c];
    if (const std::vector<State> own = contact.law->user_law_states(); !own.empty()) {
      states.push_back({own[contact.initial_law_state], contact.initial_memory});
      continue;
    }
    ContactState s;
    ContactMotion m;
    contact::set_displacement(contact, u, forcing.surface(c, t, 0), m);
    contact::set_velocity(contact, v, forcing.surface(c, t, 1), m);
    // Rigid contacts are open in this guess; touching ones are decided later, together.
    const bool carries =
        contact.normal_force_given() ? !forcing.is_unloaded(c) : contact.normal_spring() && m.gap < 0.0;
    if (carries) {
      s.state = contact::state_at_rest(contact);
      if (contact.tangential_stiffness) {
        s.anchor = contact::slip_of(contact, m.ut, contact.initial_shear);
      }
      const double size = std::abs(forcing.surface(c, t, 1)) + contact.tangent.magnitude(v);
      if (contact.sticks_rigidly() &&
          std::abs(m.vt) > rounding::many_operations * size + forcing.surface_rounding(c, t))
        s.state = contact::slip_state(m.vt);
      else if (contact.has_friction() && contact.initial_slip != 0)
        s.state = contact.initial_slip > 0 ? State::slip_plus : State::slip_minus;
    }
    states.push_back(s);
  }
  return states;
}

bool resolve_slip_reversal(const Model& model, const std::vector<ContactMotion>& before,
                           const std::vector<MotionJet>& after, contact::ContactStates& states) {
  bool turned = false;
  for (std::size_t c = 0; c < states.size(); ++c) {
    const Contact& contact = model.contacts[c];
    const int sign = slip_sign(states[c].state);
    if (sign == 0 || !contact.anchor_spring()) continue;
    const bool massless = std::any_of(
        contact.tangent.terms.begin(), contact.tangent.terms.end(),
        [&](const auto& term) { return model.dofs[static_cast<std::size_t>(term.first)].massless; });
    if (!massless) continue;
    const double p = contact::slip_of(contact, before[c]),
                 slip = contact::slip_of(contact, after[c].motion[0]) - p;
    const ContactMotion& noise = after[c].noise[0];
    if (!(-sign * slip > 2.0 * (noise.ut + noise.T / *contact.tangential_stiffness))) continue;
    states[c] = {State::stick, p};
    turned = true;
  }
  return turned;
}

void apply_forcing_jump(const Model& model, const Instant& instant, const motion::Forcing& before,
                        const motion::Forcing& after, const std::vector<ContactMotion>& motion,
                        contact::ContactStates& states) {
  const double t = instant.t;
  for (std::size_t c = 0; c < states.size(); ++c) {
    const Contact& contact = model.contacts[c];
    ContactState& s = states[c];
    if (contact.normal_spring() || (contact.takes_impulses() && s.is_open())) continue;
    if (!contact.obeys_coulomb()) continue;  // the guards of its own states decide
    ContactMotion m;
    contact::set_displacement(contact, instant.u, after.surface(c, t, 0), m);
    contact::set_velocity(contact, instant.v, after.surface(c, t, 1), m);
    if (after.is_unloaded(c)) {
      s = {State::open, 0.0};
      continue;
    }
    // Adjacent pieces of a smooth table differ by rounding; this is not a jump.
    const double speed = std::abs(after.surface(c, t, 1)) + std::abs(before.surface(c, t, 1));
    double surface_jump = after.surface(c, t, 1) - before.surface(c, t, 1);
    if (std::abs(surface_jump) <= same_value * (speed + model.scales.velocity)) surface_jump = 0.0;
    const bool moves = std::abs(m.vt) > rounding::many_operations *
                                                (std::abs(after.surface(c, t, 1)) + std::abs(surface_jump)) +
                                            after.surface_rounding(c, t);
    if (s.is_open()) {
      s = {contact::state_at_rest(contact), m.ut};
      if (contact.sticks_rigidly() && moves) s.state = contact::slip_state(m.vt);
      continue;
    }
    const int sign = slip_sign(s.state);
    if (contact.tangential_stiffness) {
      // If the compression jumps up, T is continuous and below its new limit, so the contact sticks.
      const double now = after.applied_normal_force(c, t, 0), then = before.applied_normal_force(c, t, 0);
      if (sign != 0 && now - then > same_value * (std::abs(now) + std::abs(then)))
        s = {State::stick, contact::slip_of(contact, m.ut, motion[c].T)};
    } else if (contact.sticks_rigidly() && surface_jump != 0.0 && moves) {
      s.state = contact::slip_state(m.vt);
    }
  }
}

}  // namespace signorini::decide
