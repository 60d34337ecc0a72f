#include "decide/rigid_contact_solver.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/rounding.hpp"
#include "contact/friction.hpp"
#include "contact/motion.hpp"
#include "decide/coulomb_problem.hpp"

namespace signorini::decide {
namespace {

/// sqrt(eps), as a fraction of the scale of velocities. A larger difference of two velocities is not a rounding error, because
/// no engine loses half of its digits.
constexpr double sqrt_eps = 0x1p-26;
/// Limit of the number of successive impacts at one instant. Unless e is almost one, capture_velocity ends a sequence of
/// rebounds after far fewer impacts.
constexpr int max_impacts_at_instant = 1000;

double norm_of(const Combination& form) {
  double squared = 0.0;
  for (const auto& [dof, factor] : form.terms) squared += factor * factor;
  return std::sqrt(squared);
}

/// Rounding error of a form of the velocities: 64 eps |form| |v|, where |v| includes only velocities in the form. Velocities
/// that are constrained to zero contain rounding errors of corrections, which are relative to all velocities (`rest`).
double rounding_of(const Combination& form, const Vector& v) {
  const double rest = rounding::eps * v.norm();
  double v_squared = 0.0;
  for (const auto& [dof, factor] : form.terms) v_squared += v[dof] * v[dof];
  return rounding::many_operations * norm_of(form) * (std::sqrt(v_squared) + rest);
}

/// Norm of all translational velocities; angular velocities have another unit and are omitted.
double speed_of(const Model& model, const Vector& v) {
  double squared = 0.0;
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (!model.dofs[static_cast<std::size_t>(i)].rotation) squared += v[i] * v[i];
  return std::sqrt(squared);
}

/// Energy dissipated by capture impulses: -sum of impulse times mean velocity. before, now: sums of capture impulses before and
/// after a step, whose difference is the impulse of the step; twice: velocities before plus velocities after the step.
double loss_of(const Model& model, const Block& touching, const Eigen::VectorXd& before,
               const Eigen::VectorXd& now, const Vector& twice) {
  double loss = 0.0;
  if (now.size() == 0) return loss;
  for (const std::size_t c : touching)
    for (const auto& [place, form] : {std::pair{model.layout.normal(c), &model.contacts[c].normal},
                                      std::pair{model.layout.tangent(c), &model.contacts[c].tangent}}) {
      const double impulse = now.data()[place] - (before.size() > 0 ? before.data()[place] : 0.0);
      if (impulse != 0.0) loss -= 0.5 * impulse * form->dot(twice);
    }
  return loss;
}

}  // namespace

void ImpactResult::capture(const Model& model, const std::vector<std::size_t>& contacts,
                           const Eigen::VectorXd& impulses) {
  if (impulses.size() == 0) return;
  if (capture_impulses.size() == 0) capture_impulses.setZero(model.force_count());
  const ForceLayout layout = model.layout.part(contacts);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    capture_impulses.data()[model.layout.normal(contacts[i])] += impulses[normal_place(layout, i)];
    capture_impulses.data()[model.layout.tangent(contacts[i])] += impulses[tangent_place(layout, i)];
  }
}

void ImpactResult::capture(const Eigen::VectorXd& impulses) {
  if (impulses.size() == 0) return;
  if (capture_impulses.size() == 0) capture_impulses.setZero(impulses.size());
  capture_impulses += impulses;
}

RigidContactSolver::RigidContactSolver(motion::StateSystems& systems, motion::JetMaker& jets,
                                       double capture_velocity)
    : model_(systems.model()),
      systems_(systems),
      jets_(jets),
      capture_velocity_(capture_velocity),
      impacts_(systems, capture_velocity),
      levels_(systems, jets) {}

/// Slip rate (t.v minus surface velocity) up to which the contact is at rest: rounding error plus Instant::rest_speed. At the
/// start, the rounding error of the given velocities is included.
double RigidContactSolver::slip_rate_tolerance(std::size_t c, const motion::Forcing& forcing,
                                               const Instant& instant) const {
  const double given = instant.start ? rounding::few_operations * model_.scales.velocity : 0.0;
  return given + rounding_of(model_.contacts[c].tangent, instant.v) +
         rounding::many_operations * std::abs(forcing.surface(c, instant.t, 1)) +
         forcing.surface_rounding(c, instant.t) + instant.rest_speed;
}

double RigidContactSolver::min_flight_speed(std::size_t c) const {
  return model_.contacts[c].capture_velocity.value_or(capture_velocity_);
}

/// Decides whether a contact with g = 0 leaves. The contact stays if its flight would be shorter than the resolution of time. A
/// flight is low if its speed is below capture_velocity, or if its height is below the rounding error of the gap and the engine
/// does not resolve such flights. The pull, which closes the gap again, is the larger of -g'' before and after the instant:
/// after the instant g'' may be zero, because all touching bodies fall freely together. pull_before: -g'' before the instant.
RigidContactSolver::Departure RigidContactSolver::departure(std::size_t c, const MotionJet& free,
                                                            double pull_before,
                                                            const Instant& instant) const {
  const Contact& contact = model_.contacts[c];
  const ContactMotion &m = free.motion[0], &noise = free.noise[0];
  const double pull = std::max(-m.an, pull_before);
  // For a body at rest, g' contains rounding errors of the equilibrium, which exceed the rounding error of the velocity.
  const double rounding = instant.noise_factor * noise.vn + rounding_of(contact.normal, instant.v) +
                          instant.resolution * std::abs(pull);
  if (!(pull > 0.0)) return {m.vn <= rounding ? Departure::Type::stays : Departure::Type::leaves};
  double low = min_flight_speed(c);
  if (!instant.resolves_low_flights)
    low = std::max(low, std::sqrt(2.0 * pull * std::max(noise.gap, std::abs(m.gap))));
  const double ratio = m.vn / (rounding + low);
  if (m.vn <= rounding) return {Departure::Type::stays, ratio};
  return {m.vn <= rounding + low ? Departure::Type::low : Departure::Type::leaves, ratio};
}

/// True if a dashpot makes the compressive force of a contact increase by a jump, -cn n . (v+ - v-) > 0. Velocities that do not
/// jump contain rounding errors relative to the jumps of all velocities.
bool RigidContactSolver::compression_jumps_up(std::size_t c, const Vector& before,
                                              const Vector& after) const {
  const Contact& contact = model_.contacts[c];
  if (!(contact.normal_damping > 0.0)) return false;
  // In a beam the effect of an impact decays by a factor of 0.3 per node. An effect below the rounding error of an elimination
  // is not a jump.
  const double rounding = rounding_of(contact.normal, before) + rounding_of(contact.normal, after) +
                          4.0 * rounding::elimination * norm_of(contact.normal) *
                              (speed_of(model_, before) + speed_of(model_, after));
  return contact::gap_rate(contact, after) - contact::gap_rate(contact, before) < -rounding;
}

/// Changes states according to the velocities after an impact. Rigidly sticking sliders slip if their slip rate is not zero.
/// If a dashpot makes |N| jump up, T is continuous and below its new limit, so the contact sticks. If |N| jumps down, T
/// follows its limit. If N does not jump, slip continues until the guard of slip fails.
void RigidContactSolver::update_states_after_impact(const Instant& instant, const Vector& before,
                                                    const motion::Forcing& after, const Block& block,
                                                    const std::vector<ContactMotion>& motion,
                                                    contact::ContactStates& states) const {
  for (const std::size_t c : block) {
    const Contact& contact = model_.contacts[c];
    if (contact.tangential_stiffness && slip_sign(states[c].state) != 0 &&
        compression_jumps_up(c, before, instant.v))
      states[c] = {State::stick, contact::slip_of(contact, motion[c])};
    if (!contact.constrains_tangent_only() || states[c].is_open()) continue;
    const double vt = contact::along_surface(contact, instant.v, after.surface(c, instant.t, 1));
    // A sticking contact is at rest up to rounding errors relative to all velocity jumps, as in compression_jumps_up().
    const double of_jump =
        slip_sign(states[c].state) == 0
            ? rounding::elimination * norm_of(contact.tangent) * speed_of(model_, instant.v - before)
            : 0.0;
    if (std::abs(vt) > of_jump + slip_rate_tolerance(c, after, instant))
      states[c].state = contact::slip_state(vt);
  }
}

/// Sets velocities of participants at rest to zero: g' and, without slip, the slip rate. All are set together, because each
/// change affects the other velocities. False: these velocities are already exactly zero.
bool RigidContactSolver::set_resting_velocities(Instant& instant, const motion::Forcing& forcing,
                                                const motion::StateSystem& free, const TouchingContacts& met,
                                                ImpactResult& found) const {
  const ForceLayout layout = model_.layout.part(met.contacts);
  std::vector<FixedVelocity> fixed;
  for (std::size_t i = 0; i < met.contacts.size(); ++i) {
    const std::size_t c = met.contacts[i];
    const Contact& contact = model_.contacts[c];
    const auto participant = std::find_if(found.participants.begin(), found.participants.end(),
                                          [&](const Participant& p) { return p.contact == c; });
    if (participant == found.participants.end()) continue;
    fixed.push_back({normal_place(layout, i), &contact.normal, 0.0});
    found.known[c].closing.zeros = 2;
    if (!contact.has_friction() || participant->slipping) continue;
    fixed.push_back({tangent_place(layout, i), &contact.tangent, forcing.surface(c, instant.t, 1)});
    found.known[c].sliding.zeros = 1;
  }
  if (has_velocities(fixed, instant.v)) return false;
  const Eigen::VectorXd impulses = impose_velocities(delassus(model_, free, met.contacts), fixed, instant.v);
  found.capture(with_reactions(model_, free, met.contacts, impulses));
  return true;
}

/// Updates slip directions after set_resting_velocities() has changed velocities. True: at least one more contact is at rest.
bool RigidContactSolver::update_slip_directions(const Instant& instant, const motion::Forcing& forcing,
                                                const TouchingContacts& met, ImpactResult& found) const {
  bool rests = false;
  for (Participant& participant : found.participants) {
    const std::size_t c = participant.contact;
    if (!participant.slipping || !std::binary_search(met.contacts.begin(), met.contacts.end(), c)) continue;
    const Contact& contact = model_.contacts[c];
    const double vt = contact::along_surface(contact, instant.v, forcing.surface(c, instant.t, 1));
    participant.sign = vt > 0.0 ? 1 : -1;
    participant.sliding_friction = contact::sliding_friction(contact, std::abs(vt));
    if (std::abs(vt) > slip_rate_tolerance(c, forcing, instant)) continue;
    participant.slipping = false;
    rests = true;
  }
  return rests;
}

/// Rounding errors accumulated in g and g'. From the start of the run to time t, an error da of g'' gives an error dv = t da of
/// all velocities and du = t^2/2 da of displacements. At the last touch g and g' were known exactly. In the time s since then,
/// dv has changed g, and da has changed g'. Through the stiffness of the structure, du has changed g by du min(1, (w s)^2/2)
/// and g' by du w min(1, w s); w: highest frequency. For stiff structures and long times this bound is too large, so it is
/// limited: velocities that differ by more than sqrt_eps of their scale are different.
RigidContactSolver::AccumulatedRounding RigidContactSolver::accumulated_rounding(
    std::size_t c, double da, const Instant& instant) const {
  if (instant.last_touch.empty()) return {};
  const double t = instant.t, s = t - instant.last_touch[c], w = model_.omega_max, du = 0.5 * t * t * da;
  const double angle = std::min(1.0, w * s);
  const double most = sqrt_eps * model_.scales.velocity;
  return {std::min(t * da * s + du * 0.5 * angle * angle, most * s), std::min(da * s + du * w * angle, most)};
}

/// Rounding error of a gap. If the contact has touched before, its gap was exactly zero then, and only the sum g0 + n . u has a
/// rounding error. Otherwise the result is of_data, because the terms of the sum also have errors.
double RigidContactSolver::rounding_of_gap(std::size_t c, double of_data, const Instant& instant) const {
  const bool flew = !instant.last_touch.empty() && instant.last_touch[c] > 0.0;
  const Contact& contact = model_.contacts[c];
  return flew ? rounding::few_operations * (contact.normal.magnitude(instant.u) + std::abs(contact.gap))
              : of_data;
}

RigidContactSolver::TouchingContacts RigidContactSolver::find_touching(
    const Instant& instant, const std::vector<MotionJet>& jets, const std::vector<FailedGuard>& failed,
    const Block& block, const contact::ContactStates& states) const {
  const auto is_zero = [&](double value, double noise, double rate) {
    return std::abs(value) <= noise + instant.resolution * std::abs(rate);
  };
  // At the start, the rounding errors of given values are relative to the scales of the scene, even for very small values.
  const double given = instant.start ? rounding::few_operations * model_.scales.displacement : 0.0;
  const double given_rate = instant.start ? rounding::few_operations * model_.scales.velocity : 0.0;
  TouchingContacts met;
  int together = 0;
  bool doubtful = false;
  for (const std::size_t c : block) {
    if (!model_.contacts[c].takes_impulses()) continue;
    const ContactMotion &m = jets[c].motion[0], &noise = jets[c].noise[0];
    const bool open = states[c].is_open();
    const AccumulatedRounding carried = accumulated_rounding(c, noise.an, instant);
    const double known = rounding_of_gap(c, noise.gap, instant) + given;
    // A contact that closes faster than min_flight_speed() is hit even if accumulated rounding errors are larger.
    const double unsure = std::min(carried.rate + instant.resolution * std::abs(m.an), min_flight_speed(c));
    Approach a{c,   0.0, m.vn, noise.vn + given_rate + min_flight_speed(c), noise.vn + unsure + given_rate,
               open};
    // A contact whose gap has become negative may touch, too: it closes together with other contacts, within the resolution.
    const bool pull_before =
        std::any_of(failed.begin(), failed.end(), [&](const FailedGuard& f) { return f.contact == c; });
    const bool touches = !open || instant.has_triggered(c, Guard::closing) || std::abs(m.gap) <= known ||
                         is_held_at_zero_gap(systems_, c, states, instant.u);
    const bool split = !touches && (pull_before || std::abs(m.gap) <= known + carried.gap) &&
                       closes_with_others(a, instant, jets, failed, block);
    const bool comes = is_zero(m.gap, known, m.vn);
    const bool above = !touches && !split && !comes;
    if (above && !pull_before) continue;
    if (!touches && !split) a.gap = std::max(m.gap, 0.0);
    met.unresolved = met.unresolved || (above && m.gap > 0.0) || (split && !comes);
    met.contacts.push_back(c);
    met.approaches.push_back(a);
    met.apart = met.apart || m.gap != 0.0;
    met.hit = met.hit || a.is_closing();
    // Several contacts that close within the rounding errors of their gaps are hit together, because rounding hides their
    // order.
    const double own =
        rounding::few_operations * (model_.contacts[c].normal.magnitude(instant.u) +
                                    std::abs(model_.contacts[c].gap) + instant.t * std::abs(m.vn));
    if (!a.is_closing() || a.gap > 0.0) continue;
    ++together;
    doubtful = doubtful || (!instant.has_triggered(c, Guard::closing) && std::abs(m.gap) > own + given);
  }
  met.unresolved = met.unresolved || (together > 1 && doubtful);
  return met;
}

/// True if the contact is at rest, or has the same gap rate, up to rounding, as another contact of the block that closes now.
bool RigidContactSolver::closes_with_others(const Approach& a, const Instant& instant,
                                            const std::vector<MotionJet>& jets,
                                            const std::vector<FailedGuard>& failed,
                                            const Block& block) const {
  if (std::abs(a.rate) <= a.rest) return true;
  const double alike = a.hit + sqrt_eps * model_.scales.velocity;
  return std::any_of(block.begin(), block.end(), [&](std::size_t c) {
    const bool falls =
        instant.has_triggered(c, Guard::closing) ||
        std::any_of(failed.begin(), failed.end(), [&](const FailedGuard& f) { return f.contact == c; });
    const double apart = std::abs(jets[c].motion[0].vn - a.rate);
    return c != a.contact && falls && model_.contacts[c].takes_impulses() && apart <= alike;
  });
}

/// Computes the successive impacts of one instant, until no contact closes.
Refusal RigidContactSolver::apply_impacts(Instant& instant, const motion::Forcing& forcing,
                                          const TouchingContacts& met, const Block& block,
                                          ImpactResult& found, Decision& decision,
                                          contact::ContactStates& states) {
  std::vector<Approach> all = met.approaches;
  for (int turn = 0; turn < max_impacts_at_instant; ++turn) {
    const Block struck = next_impact(all);
    if (struck.empty()) return {};
    if (Refusal why = apply_impact(instant, forcing, struck, block, found, decision, states)) return why;
    for (Approach& a : all) {
      a.rate = contact::gap_rate(model_.contacts[a.contact], instant.v);
      a.rest = std::max(
          a.rest, min_flight_speed(a.contact) + rounding_of(model_.contacts[a.contact].normal, instant.v));
      a.hit = a.rest;
      if (!(a.rate > a.rest)) continue;
      states[a.contact] = {State::open, 0.0};
      a.open = true;
      // A contact that an earlier impact stopped now leaves, so its record must not say that it rests.
      if (Impulse& sum = decision.impulses[a.contact]; sum.rests) sum.rests = sum.sticks = false;
    }
  }
  return {Refusal::Kind::endless,
          fmt::format("{} successive impacts at one instant do not end; a greater capture_velocity ends "
                      "rebounds sooner",
                      max_impacts_at_instant),
          met.contacts};
}

/// Computes one impact. struck: contacts that are hit.
Refusal RigidContactSolver::apply_impact(Instant& instant, const motion::Forcing& forcing,
                                         const Block& struck, const Block& block, ImpactResult& found,
                                         Decision& decision, contact::ContactStates& states) {
  const Impact result = impacts_.solve(forcing, instant.t, states, struck, instant.v);
  if (result.refusal) return result.refusal;
  const Vector before = std::exchange(instant.v, result.v);
  found.capture(model_, struck, result.correction_impulses);
  for (const std::size_t c : block) {
    found.stays[c] = found.rests[c] = false;
    found.known[c].sliding = {};
  }
  decision.impact_loss += result.loss;
  decision.impact_surface_work += result.surface_work;
  decision.impact_gains_energy = decision.impact_gains_energy || result.gains;
  if (decision.impulses.empty()) decision.impulses.resize(states.size());
  const int impact_number =
      decision.single_impacts.empty() ? 1 : decision.single_impacts.back().impact_number + 1;
  for (const std::size_t c : struck) {
    Impulse& sum = decision.impulses[c];
    decision.single_impacts.push_back(
        {c, impact_number, result.impulses[c].normal, result.impulses[c].tangent});
    sum.hit = sum.hit || result.impulses[c].hit;
    sum.normal += result.impulses[c].normal;
    sum.tangent += result.impulses[c].tangent;
    sum.rests = result.impulses[c].rests;
    sum.sticks = result.impulses[c].sticks;
    sum.rebound = result.impulses[c].rebound;
  }
  update_states_after_impact(instant, before, forcing, block, decision.before, states);
  return {};
}

/// Adds the touching contacts that do not leave to found.participants. free: motion with all touching contacts open.
void RigidContactSolver::add_staying_contacts(const Instant& instant, const motion::Forcing& forcing,
                                              const TouchingContacts& met, const std::vector<MotionJet>& free,
                                              const Decision& decision, ImpactResult& found) const {
  for (const std::size_t c : met.contacts) {
    const Contact& contact = model_.contacts[c];
    const ContactMotion &m = free[c].motion[0], &noise = free[c].noise[0];
    const Impulse struck = met.hit ? decision.impulses[c] : Impulse{};
    if (!struck.rests && !found.stays[c]) {
      using How = Departure::Type;
      const bool open = instant.states[c].is_open();
      const double pull_before = open ? -decision.before[c].an : 0.0;
      const auto [how, ratio] = departure(c, free[c], pull_before, instant);
      found.departures[c] = ratio;
      if (how == How::leaves || (how == How::low && instant.keep_low_flights)) continue;
      found.flight_taken_as_rest = found.flight_taken_as_rest || how == How::low;
      found.unresolved = found.unresolved || (min_flight_speed(c) > 0.0 && m.vn > min_flight_speed(c));
      found.max_rest_speed = std::max(found.max_rest_speed, m.vn);
    }
    found.stays[c] = true;
    const double zero =
        noise.vt + slip_rate_tolerance(c, forcing, instant) + instant.resolution * std::abs(m.at);
    const bool rests = struck.sticks || found.rests[c] ||
                       (!met.hit && instant.has_triggered(c, Guard::sliding)) || std::abs(m.vt) <= zero;
    Participant participant{c};
    participant.slipping = contact.has_friction() && !rests;
    participant.sign = m.vt > 0.0 ? 1 : -1;
    participant.sliding_friction = contact::sliding_friction(contact, rests ? 0.0 : std::abs(m.vt));
    participant.kinetic = found.kinetic[c];
    participant.stays_at_limit = found.stays_at_limit[c];
    found.participants.push_back(participant);
  }
}

/// For several feet of one body: marks participants as not slipping if other participants at rest constrain their motion,
/// because their slip rate is then only rounding.
void RigidContactSolver::stop_constrained_participants(const Instant& instant, const motion::Forcing& forcing,
                                                       const contact::ContactStates& states,
                                                       ImpactResult& found) const {
  contact::ContactStates held = states;
  for (const Participant& participant : found.participants)
    held[participant.contact].state = !model_.contacts[participant.contact].has_friction() ? State::closed
                                      : participant.slipping ? contact::slip_state(participant.sign)
                                                             : State::stick;
  for (Participant& participant : found.participants) {
    const std::size_t c = participant.contact;
    if (!participant.slipping || !systems_.held_by_others(c, held, forcing, instant.t)) continue;
    const double vt = contact::along_surface(model_.contacts[c], instant.v, forcing.surface(c, instant.t, 1));
    if (std::abs(vt) > min_flight_speed(c) + rounding::many_operations * model_.scales.velocity) continue;
    participant.slipping = false;
    participant.sliding_friction = contact::sliding_friction(model_.contacts[c], 0.0);
    held[c].state = State::stick;
  }
}

/// Sliders at rest that may share forces with other contacts, because several contacts of a group may constrain the same
/// motion. Only groups in which a contact has changed its state are examined.
std::vector<std::size_t> RigidContactSolver::sharing(const Instant& instant, const motion::Forcing& forcing,
                                                     const contact::ContactStates& states,
                                                     const Decision& decision) const {
  std::vector<std::size_t> at_rest;
  for (const std::vector<std::size_t>& group : systems_.sharing()) {
    if (std::none_of(group.begin(), group.end(), [&](std::size_t c) { return decision.visited[c]; }))
      continue;
    contact::ContactStates held = states;
    const auto stops = [&](std::size_t c) {
      if (states[c].state == State::stick || instant.has_triggered(c, Guard::sliding)) return true;
      const double vt =
          contact::along_surface(model_.contacts[c], instant.v, forcing.surface(c, instant.t, 1));
      const double held_too = systems_.held_by_others(c, held, forcing, instant.t)
                                  ? min_flight_speed(c) + rounding::many_operations * model_.scales.velocity
                                  : 0.0;
      return std::abs(vt) <= std::max(slip_rate_tolerance(c, forcing, instant), held_too);
    };
    for (int round = 0; round < 2;
         ++round)  // second round: contacts stopped in the first round may hold others
      for (const std::size_t c : group)
        if (model_.contacts[c].normal_force_given() && !states[c].is_open() && stops(c))
          held[c].state = State::stick;
    std::copy_if(group.begin(), group.end(), std::back_inserter(at_rest), [&](std::size_t c) {
      return model_.contacts[c].normal_force_given() && held[c].state == State::stick;
    });
  }
  return at_rest;
}

/// Adds sliders to the participants: sliders that an impact has stopped, the sliders of sharing(), and, if found.sliders is
/// true, sliders that have changed their states.
void RigidContactSolver::add_sliders(const Instant& instant, const motion::Forcing& forcing,
                                     const TouchingContacts& met, const Block& block,
                                     const contact::ContactStates& states, const Decision& decision,
                                     ImpactResult& found) const {
  const std::vector<std::size_t> together = sharing(instant, forcing, states, decision);
  for (const std::size_t c : block) {
    const Contact& contact = model_.contacts[c];
    if (!contact.constrains_tangent_only()) continue;
    const bool shares = std::find(together.begin(), together.end(), c) != together.end();
    const double vt = contact::along_surface(contact, instant.v, forcing.surface(c, instant.t, 1));
    const bool stopped = met.hit && slip_sign(states[c].state) != 0 &&
                         std::abs(vt) <= slip_rate_tolerance(c, forcing, instant);
    if (!stopped && !shares && !(found.sliders && decision.visited[c])) continue;
    Participant participant{c};
    participant.sliding_friction = contact::sliding_friction(contact, 0.0);
    participant.kinetic = found.kinetic[c];
    participant.stays_at_limit = found.stays_at_limit[c];
    if (shares) found.known[c].sliding.zeros = 1;
    found.known[c] = found.known[c].of_motion();
    found.participants.push_back(participant);
  }
}

/// Adds all rigidly sticking sliders to the participants, because consistent states may exist only if they slip. False: no
/// slider was added.
bool RigidContactSolver::add_sticking_sliders(const std::vector<Block>& blocks,
                                              const contact::ContactStates& states,
                                              ImpactResult& found) const {
  std::vector<Participant> all;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    std::copy_if(found.participants.begin(), found.participants.end(), std::back_inserter(all),
                 [&](const Participant& participant) { return participant.block == b; });
    for (const std::size_t c : blocks[b]) {
      const Contact& contact = model_.contacts[c];
      const bool takes_part = std::any_of(
          all.begin(), all.end(), [&](const Participant& participant) { return participant.contact == c; });
      if (!contact.constrains_tangent_only() || states[c].state != State::stick || takes_part) continue;
      Participant participant{c};
      participant.sliding_friction = contact::sliding_friction(contact, 0.0);
      participant.kinetic = found.kinetic[c];
      participant.stays_at_limit = found.stays_at_limit[c];
      participant.block = b;
      all.push_back(participant);
    }
  }
  const bool some = all.size() > found.participants.size();
  if (some) found.participants = std::move(all);
  return some;
}

/// Decides the participants (decide/derivative_levels.hpp). If there is no motion, several motions, or dependent constraint
/// rows while some sliders keep sticking, these sliders are decided together with the participants.
Refusal RigidContactSolver::solve_levels(const Instant& instant, const motion::Forcing& forcing,
                                         const std::vector<Block>& blocks, const contact::ContactStates& old,
                                         ImpactResult& found, contact::ContactStates& states) {
  const contact::ContactStates held = states;
  const std::vector<KnownGuards> known = found.known;
  Refusal refusal = levels_.decide(instant, forcing, found.participants, old, states, found.known);
  const bool painleve = refusal.kind == Refusal::Kind::paradox || refusal.kind == Refusal::Kind::ambiguous;
  const bool dependent =
      refusal ? refusal.kind == Refusal::Kind::dependent : systems_.system_of(states) == nullptr;
  if (!(painleve || dependent) || !add_sticking_sliders(blocks, held, found)) return refusal;
  states = held;
  found.known = known;
  for (const Participant& participant : found.participants)
    if (model_.contacts[participant.contact].normal_force_given())
      found.known[participant.contact] = known[participant.contact].of_motion();
  const Refusal together = levels_.decide(instant, forcing, found.participants, old, states, found.known);
  return together ? refusal : Refusal{};
}

Refusal RigidContactSolver::decide(Instant& instant, const motion::Forcing& forcing,
                                   const std::vector<MotionJet>& jets, const std::vector<FailedGuard>& failed,
                                   const std::vector<Block>& blocks, ImpactResult& found, Decision& decision,
                                   contact::ContactStates& states) {
  const contact::ContactStates old = states;
  std::vector<TouchingContacts> all;
  for (const Block& block : blocks) {
    const TouchingContacts& met = all.emplace_back(find_touching(instant, jets, failed, block, states));
    found.hit = found.hit || met.hit;
    found.unresolved = found.unresolved || met.unresolved;
    for (const std::size_t c : met.contacts) {
      found.known[c] = {};
      found.known[c].touches = true;
      found.known[c].closing.zeros = 1;
    }
  }
  for (std::size_t b = 0; b < all.size(); ++b) {
    const TouchingContacts& met = all[b];
    if (met.hit)
      if (Refusal why = apply_impacts(instant, forcing, met, blocks[b], found, decision, states)) return why;
    if (met.apart) instant.u = impacts_.close_gaps(states, met.contacts, instant.u);
  }
  for (const TouchingContacts& met : all)
    for (const std::size_t c : met.contacts) states[c] = {State::open, 0.0};
  const motion::StateSystemPtr system = systems_.system_of(states);
  if (!system)
    return {Refusal::Kind::singular, "the equations of motion without rigid contacts are singular", {}};
  Block touching;
  for (const TouchingContacts& met : all)
    touching.insert(touching.end(), met.contacts.begin(), met.contacts.end());
  std::vector<MotionJet> free;
  const motion::Jet free_jet = jets_.make(system, forcing, instant.t, instant.u, instant.v, free);
  found.participants.clear();
  const Vector moving = instant.v;
  const Eigen::VectorXd captured = found.capture_impulses;
  std::size_t placed = 0;
  for (std::size_t b = 0; b < all.size(); ++b) {
    add_staying_contacts(instant, forcing, all[b], free, decision, found);
    stop_constrained_participants(instant, forcing, states, found);
    // The loop ends, because in each round at least one more contact comes to rest.
    while (set_resting_velocities(instant, forcing, *free_jet.system, all[b], found))
      if (!update_slip_directions(instant, forcing, all[b], found)) break;
    add_sliders(instant, forcing, all[b], blocks[b], states, decision, found);
    for (; placed < found.participants.size(); ++placed) found.participants[placed].block = b;
  }
  // If an impact at another contact lifts a contact more slowly than capture_velocity, the contact is stopped, and its kinetic
  // energy is dissipated.
  decision.impact_loss += loss_of(model_, touching, captured, found.capture_impulses, moving + instant.v);
  Refusal refusal = solve_levels(instant, forcing, blocks, old, found, states);
  for (const Participant& participant : found.participants) {
    found.decided[participant.contact] = true;
    if (states[participant.contact] != old[participant.contact]) decision.visited[participant.contact] = true;
  }
  return refusal;
}

}  // namespace signorini::decide
