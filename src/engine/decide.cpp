#include "engine/decide.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "engine/joint_decision.hpp"

namespace signorini {
namespace {

constexpr double same_speed = 1e-12;  // of two pieces of a history where they meet smoothly

struct Sign {
  int sign = 0;   // -1, 0, +1
  int order = 0;  // of the derivative that decides; past the last one when all vanish
};

/// Sign of the first derivative of the form, from `first` on, that is not zero to working precision. A
/// derivative also counts as zero when the next one would undo it within the resolution.
Sign sign_after(const Form& form, const MotionJet& jet, double resolution, std::size_t first) {
  for (std::size_t k = first; k < jet.motion.size(); ++k) {
    const double d = k == 0 ? form.value(jet.motion[0]) : form.rate(jet.motion[k]);
    double zero = form.magnitude(jet.noise[k]);
    if (k + 1 < jet.motion.size()) zero += resolution * std::abs(form.rate(jet.motion[k + 1]));
    if (std::abs(d) > zero) return {d > 0.0 ? 1 : -1, static_cast<int>(k)};
  }
  return {0, static_cast<int>(jet.motion.size())};
}

/// How a guard passed through zero, from the motion in the mode that it ended.
Crossing crossing(const Form& form, const MotionJet& jet) {
  Crossing result{form, true, {}, form.magnitude(jet.noise[0])};
  for (std::size_t k = 1; k < jet.motion.size(); ++k) result.derivatives[k - 1] = form.rate(jet.motion[k]);
  return result;
}

bool starts_at_zero(const Form& form, const MotionJet& jet, double resolution) {
  const double zero = form.magnitude(jet.noise[0]) + resolution * std::abs(form.rate(jet.motion[1]));
  return std::abs(form.value(jet.motion[0])) <= zero;
}

using Memory = std::tuple<State, double, bool>;

/// States and memories, for recognising a cycle.
std::vector<Memory> states(const Mode& mode) {
  std::vector<Memory> result;
  for (const ContactState& c : mode) result.emplace_back(c.state, c.anchor, c.inside);
  return result;
}

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
        if (std::abs(vt) > 8.0 * std::numeric_limits<double>::epsilon() * size)
          s.state = vt > 0.0 ? State::slip_plus : State::slip_minus;
      }
    }
    mode.push_back(s);
  }
  return mode;
}

Decider::Decider(const Model& model, Expander& expander, int max_rounds, double capture_velocity)
    : model_(model),
      expander_(expander),
      max_rounds_(max_rounds),
      impacts_(model, expander, capture_velocity) {}

std::vector<Decider::Failure> Decider::failures(const std::vector<MotionJet>& jets, const Mode& mode,
                                                const Instant& instant, bool first) const {
  std::vector<Failure> result;
  for (std::size_t c = 0; c < mode.size(); ++c) {
    Failure failure{c, Guard::none};
    int order = std::numeric_limits<int>::max();
    for (const GuardForm& guard : guards(model_.contacts[c], mode[c])) {
      if (guard.kind == Guard::none) continue;
      const bool fired =
          first && std::any_of(instant.fired.begin(), instant.fired.end(),
                               [&](const Fired& f) { return f.contact == c && f.guard == guard.kind; });
      // What the integrator located is zero, also where the last rounding leaves it positive.
      const bool is_zero = fired && guard.form.value(jets[c].motion[0]) > 0.0;
      const Sign sign = sign_after(guard.form, jets[c], instant.resolution, is_zero ? 1 : 0);
      // The guard that fails soonest counts: a friction limit exceeded at once before a compression that
      // will end. At a tie separation, the first: with N = 0 the friction limit is zero too.
      if (sign.sign >= 0 || sign.order >= order) continue;
      failure.guard = guard.kind;
      failure.form = guard.form;
      order = sign.order;
    }
    if (failure.guard == Guard::none) continue;
    // Friction limit and compression vanish together in a vertical lift-off: one separation.
    if (order > 0 && (failure.guard == Guard::slip_plus || failure.guard == Guard::slip_minus)) {
      const GuardForm separation = guards(model_.contacts[c], mode[c])[0];
      if (separation.kind == Guard::separation &&
          starts_at_zero(separation.form, jets[c], instant.resolution) &&
          separation.form.rate(jets[c].motion[1]) < 0.0) {
        failure.guard = Guard::separation;
        failure.form = separation.form;
      }
    }
    result.push_back(failure);
  }
  return result;
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
                                          (std::abs(after.surface(c, t, 1)) + std::abs(surface_jump));
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

bool Decider::evaluate(const Instant& instant, const Forcing& after, const Mode& mode, Decision& decision,
                       std::vector<MotionJet>& jets) const {
  if (!expander_.set(mode)) return false;
  decision.u = instant.u;
  decision.v = instant.v;
  expander_.hold(after, instant.t, mode, decision.u, decision.v);
  decision.jet = expander_.expand(after, instant.t, decision.u, decision.v, jets);
  decision.u = decision.jet.u.col(0);
  decision.v = decision.jet.u.col(1);
  decision.mode = mode;
  return true;
}

/// What is known at an instant of the contacts whose forces may jump.
struct Decider::Joint {
  bool sliders = false;                ///< sliders that stick rigidly take part
  std::vector<bool> decided, kinetic;  ///< one a contact
};

/// Sliders that stick rigidly slip as soon as their slip rate is not zero, after an impact for example.
void Decider::follow_velocity(const Instant& instant, const Forcing& after, Mode& mode) const {
  for (std::size_t c = 0; c < mode.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    if (contact.law != Law::slider || !contact.sticks_rigidly() || mode[c].state == State::open) continue;
    double size = std::abs(after.surface(c, instant.t, 1));
    for (const auto& [dof, factor] : contact.tangent.terms) size += std::abs(factor * instant.v[dof]);
    const double vt = contact.tangent.dot(instant.v) - after.surface(c, instant.t, 1);
    if (std::abs(vt) > 64.0 * std::numeric_limits<double>::epsilon() * size)
      mode[c].state = vt > 0.0 ? State::slip_plus : State::slip_minus;
  }
}

/// Impacts where there are any, then the states. Returns why it cannot, or nothing.
std::string Decider::decide_jointly(Instant& instant, const Forcing& after, Joint& joint, Decision& decision,
                                    const std::vector<MotionJet>& jets, Mode& mode) const {
  const auto fired = [&](std::size_t c, Guard guard) {
    return std::any_of(instant.fired.begin(), instant.fired.end(),
                       [&](const Fired& f) { return f.contact == c && f.guard == guard; });
  };
  const auto is_zero = [&](double value, double noise, double rate) {
    return std::abs(value) <= noise + instant.resolution * std::abs(rate);
  };
  std::vector<std::size_t> touching;
  bool impact = false;
  for (std::size_t c = 0; c < mode.size(); ++c) {
    if (model_.contacts[c].law != Law::rigid) continue;
    const ContactMotion &m = jets[c].motion[0], &noise = jets[c].noise[0];
    if (mode[c].state == State::open && !fired(c, Guard::closing) && !is_zero(m.gap, noise.gap, m.vn))
      continue;
    touching.push_back(c);
    impact = impact || (mode[c].state == State::open && m.vn < 0.0 && !is_zero(m.vn, noise.vn, m.an));
  }
  if (impact) {
    const Impact result = impacts_.solve(after, instant.t, mode, touching, instant.u, instant.v);
    if (!result.solved) return result.reason;
    instant.u = result.u;
    instant.v = result.v;
    decision.impact_loss += result.loss;
    decision.impact_surface_work += result.surface_work;
    decision.impact_gains = decision.impact_gains || result.gains;
    if (decision.impulses.empty()) decision.impulses.resize(mode.size());
    for (const std::size_t c : touching) {
      Impulse& sum = decision.impulses[c];
      sum.hit = sum.hit || result.impulses[c].hit;
      sum.normal += result.impulses[c].normal;
      sum.tangent += result.impulses[c].tangent;
    }
    follow_velocity(instant, after, mode);
  }
  std::vector<Participant> participants;
  for (const std::size_t c : touching) {
    const Contact& contact = model_.contacts[c];
    const ContactMotion &m = jets[c].motion[0], &noise = jets[c].noise[0];
    const double vn = contact.normal.dot(instant.v);
    double size = 0.0;  // of the velocities whose difference it is
    for (const auto& [dof, factor] : contact.normal.terms) size += std::abs(factor * instant.v[dof]);
    const bool struck = impact && decision.impulses[c].normal > 0.0;
    const double zero = noise.vn + 64.0 * std::numeric_limits<double>::epsilon() * size +
                        (struck ? 0.0 : instant.resolution * std::abs(m.an));
    if (vn > zero) {
      mode[c] = {State::open, 0.0};
      continue;
    }
    Participant who{c};
    const double vt = contact.tangent.dot(instant.v) - after.surface(c, instant.t, 1);
    double tangent_size = std::abs(after.surface(c, instant.t, 1));
    for (const auto& [dof, factor] : contact.tangent.terms) tangent_size += std::abs(factor * instant.v[dof]);
    const bool rests = (!impact && fired(c, Guard::sliding)) ||
                       std::abs(vt) <= noise.vt +
                                           64.0 * std::numeric_limits<double>::epsilon() * tangent_size +
                                           instant.resolution * std::abs(m.at);
    who.slipping = contact.has_friction() && !rests;
    who.sign = vt > 0.0 ? 1 : -1;
    who.sliding_friction = sliding_friction(contact, rests ? 0.0 : std::abs(vt));
    who.kinetic = joint.kinetic[c];
    participants.push_back(who);
  }
  for (std::size_t c = 0; joint.sliders && c < mode.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    if (contact.law != Law::slider || !contact.sticks_rigidly() || !decision.visited[c]) continue;
    Participant who{c};
    who.sliding_friction = sliding_friction(contact, 0.0);
    who.kinetic = joint.kinetic[c];
    participants.push_back(who);
  }
  const Mode old = mode;
  std::string reason = JointDecision(model_, expander_).decide(instant, after, participants, mode);
  for (const Participant& who : participants) {
    joint.decided[who.contact] = true;
    if (mode[who.contact] != old[who.contact]) decision.visited[who.contact] = true;
  }
  return reason;
}

std::string Decider::describe(const std::vector<Failure>& failures) const {
  std::string text;
  for (const Failure& f : failures)
    text += fmt::format("{}'{}' ({})", text.empty() ? "" : ", ", model_.contacts[f.contact].name,
                        to_string(f.guard));
  return text;
}

std::vector<BodySlide> Decider::slides(const Forcing& forcing, double t, const Vector& u,
                                       const Vector& v) const {
  std::vector<BodySlide> result;
  for (std::size_t k = 0; k < model_.contacts.size(); ++k)
    result.push_back(slide_of(model_.contacts[k], k, forcing, t, u, v));
  return result;
}

Decision Decider::decide(Instant instant, const Forcing& before, const Forcing& after) const {
  Decision decision;
  const std::size_t count = model_.contacts.size();
  decision.visited.assign(count, false);
  decision.jumped.assign(count, false);
  decision.crossings.resize(count);
  std::vector<MotionJet> jets;
  Joint joint{false, std::vector<bool>(count, false), std::vector<bool>(count, false)};

  // The motion just before, in the old mode under the old forcing.
  if (!evaluate(instant, before, instant.mode, decision, jets)) {
    decision.reason =
        "the rows of the contacts that stick are linearly dependent, so their forces are not unique";
    return decision;
  }
  std::vector<ContactMotion> noise;
  for (const MotionJet& jet : jets) {
    decision.before.push_back(jet.motion[0]);
    noise.push_back(jet.noise[0]);
  }
  decision.slides_before = slides(before, instant.t, decision.u, decision.v);
  // What sticks rigidly moves with its surface, what touches rigidly has no gap: an integrator's drift must
  // not decide what comes next.
  instant.u = decision.u;
  instant.v = decision.v;

  Mode mode = instant.mode;
  if (instant.jump) follow_forcing(instant, before, after, decision.before, mode);
  std::vector<std::vector<Memory>> seen{states(mode)};
  bool first = true;
  if (instant.jump && !evaluate(instant, after, mode, decision, jets)) {
    decision.reason =
        "the rows of the contacts that stick are linearly dependent, so their forces are not unique";
    return decision;
  }
  for (bool open = instant.start;; open = false) {
    const std::vector<Failure> failed = failures(jets, mode, instant, first);
    first = false;
    if (failed.empty() && !open) break;
    if (++decision.rounds > max_rounds_) {
      decision.reason =
          fmt::format("{} rounds of state changes at one instant do not end; guards that fail: {}",
                      max_rounds_, describe(failed));
      return decision;
    }
    bool jointly = joint.sliders || open;
    for (const Failure& f : failed) {
      const Contact& contact = model_.contacts[f.contact];
      if (!decision.visited[f.contact]) decision.crossings[f.contact] = crossing(f.form, jets[f.contact]);
      decision.visited[f.contact] = true;
      const bool slips = f.guard == Guard::slip_plus || f.guard == Guard::slip_minus;
      if (contact.law == Law::rigid || (joint.sliders && contact.sticks_rigidly())) {
        jointly = true;
        // It was left at its static limit, and that falls.
        if (slips && joint.decided[f.contact]) joint.kinetic[f.contact] = true;
      } else {
        mode[f.contact] = next_state(contact, mode[f.contact], f.guard, jets[f.contact]);
      }
    }
    if (jointly) {
      if (std::string why = decide_jointly(instant, after, joint, decision, jets, mode); !why.empty()) {
        decision.reason = failed.empty() ? why : fmt::format("{} (after {})", why, describe(failed));
        return decision;
      }
    }
    std::vector<Memory> now = states(mode);
    if (!open && std::find(seen.begin(), seen.end(), now) != seen.end() && decision.impulses.empty()) {
      if (joint.sliders) {
        decision.reason =
            fmt::format("no combination of states is consistent; guards that fail: {}", describe(failed));
        return decision;
      }
      joint.sliders = true;
    }
    seen.push_back(std::move(now));
    if (!evaluate(instant, after, mode, decision, jets)) {
      decision.reason = fmt::format(
          "the rows of the contacts that stick are linearly dependent, so their forces are not unique "
          "(after {}); law = \"compliant\" or a tangential_stiffness makes them so",
          describe(failed));
      return decision;
    }
  }

  decision.consistent = true;
  decision.slides_after = slides(after, instant.t, decision.u, decision.v);
  for (std::size_t c = 0; c < count; ++c) {
    const ContactMotion& after_motion = jets[c].motion[0];
    decision.after.push_back(after_motion);
    decision.jumped[c] = std::abs(after_motion.N - decision.before[c].N) > noise[c].N + jets[c].noise[0].N ||
                         std::abs(after_motion.T - decision.before[c].T) > noise[c].T + jets[c].noise[0].T;
    for (const GuardForm& guard : guards(model_.contacts[c], mode[c])) {
      GuardStart start{guard.kind, guard.form};
      if (guard.kind != Guard::none) {
        start.at_zero = starts_at_zero(guard.form, jets[c], instant.resolution);
        start.noise = guard.form.magnitude(jets[c].noise[0]);
        const int order = sign_after(guard.form, jets[c], instant.resolution, 0).order;
        start.leading = order < static_cast<int>(jets[c].motion.size()) ? order : -1;
      }
      decision.guards.push_back(std::move(start));
    }
  }
  return decision;
}

Decision Decider::adopt(const Instant& instant, const Mode& mode, const Forcing& forcing) const {
  Decision decision;
  decision.visited.assign(mode.size(), false);
  decision.jumped.assign(mode.size(), false);
  decision.crossings.resize(mode.size());
  std::vector<MotionJet> jets;
  if (!evaluate(instant, forcing, mode, decision, jets)) {
    decision.reason =
        "the rows of the contacts that stick are linearly dependent, so their forces are not unique";
    return decision;
  }
  decision.consistent = true;
  for (const MotionJet& jet : jets) decision.after.push_back(jet.motion[0]);
  decision.before = decision.after;
  decision.slides_after = decision.slides_before = slides(forcing, instant.t, decision.u, decision.v);
  for (std::size_t c = 0; c < mode.size(); ++c)
    for (const GuardForm& guard : guards(model_.contacts[c], mode[c]))
      decision.guards.push_back({guard.kind, guard.form});
  return decision;
}

}  // namespace signorini
