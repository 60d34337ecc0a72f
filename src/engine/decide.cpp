#include "engine/decide.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "engine/joint_decision.hpp"

namespace signorini {
namespace {

constexpr double unlucky = 16.0;      // times noise and resolution, where decisions go in circles
constexpr double same_speed = 1e-12;  // of two pieces of a history where they meet smoothly

struct Sign {
  int sign = 0;   // -1, 0, +1
  int order = 0;  // of the derivative that decides; past the last one when all vanish
};

/// Sign of the first derivative of the form, from `first` on, that is not zero to working precision. A
/// derivative also counts as zero when the next one would undo it within the resolution.
Sign sign_after(const Form& form, const MotionJet& jet, const Instant& instant, std::size_t first) {
  for (std::size_t k = first; k < jet.motion.size(); ++k) {
    const double d = k == 0 ? form.value(jet.motion[0]) : form.rate(jet.motion[k]);
    double zero = instant.blur * form.magnitude(jet.noise[k]) + std::numeric_limits<double>::min();
    if (k + 1 < jet.motion.size()) zero += instant.resolution * std::abs(form.rate(jet.motion[k + 1]));
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

bool starts_at_zero(const Form& form, const MotionJet& jet, const Instant& instant) {
  const double zero =
      instant.blur * form.magnitude(jet.noise[0]) + instant.resolution * std::abs(form.rate(jet.motion[1]));
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
        if (std::abs(vt) >
            8.0 * std::numeric_limits<double>::epsilon() * size + forcing.surface_rounding(c, t))
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
      capture_velocity_(capture_velocity),
      impacts_(model, expander, capture_velocity) {}

std::vector<Decider::Failure> Decider::failures(const std::vector<MotionJet>& jets, const Mode& mode,
                                                const Instant& instant, bool first,
                                                const std::vector<bool>& touching) const {
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
      // So is the gap of what touches, whatever setting its neighbours' gaps to zero has made of it.
      const bool is_zero = (fired && guard.form.value(jets[c].motion[0]) > 0.0) ||
                           (touching[c] && guard.kind == Guard::closing);
      const Sign sign = sign_after(guard.form, jets[c], instant, is_zero ? 1 : 0);
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
      if (separation.kind == Guard::separation && starts_at_zero(separation.form, jets[c], instant) &&
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
  // What is slower than an acceleration undoes within the resolution of the clock is zero. The acceleration
  // is known only once a state has been tried, so these are found out in the course of a decision.
  std::vector<bool> stays, rests;  ///< vn, vt count as zero
  std::vector<bool> touching;      ///< g is zero
  explicit Joint(std::size_t n)
      : decided(n, false), kinetic(n, false), stays(n, false), rests(n, false), touching(n, false) {}
};

namespace {

/// The rounding of a form of the velocities. Where all of them are held at zero, what is left of them is the
/// rounding of corrections, square against the motion of the rest.
double rounding_of(const Combination& form, const Vector& v) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const double fastest = v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0.0;
  double size = 0.0;
  for (const auto& [dof, factor] : form.terms)
    size += std::abs(factor) * (std::abs(v[dof]) + epsilon * fastest);
  return 64.0 * epsilon * size;
}

}  // namespace

/// The rounding of t.v less the velocity of the surface.
double Decider::rounding_of_slide(std::size_t c, const Forcing& forcing, const Instant& instant) const {
  return rounding_of(model_.contacts[c].tangent, instant.v) +
         64.0 * std::numeric_limits<double>::epsilon() * std::abs(forcing.surface(c, instant.t, 1)) +
         forcing.surface_rounding(c, instant.t);
}

/// g' from which on a contact with g = 0 leaves. Slower, and pulled back, it stays: its flight would be
/// shorter than the clock resolves, lower than the rounding of its gap, or a rebound below capture_velocity.
double Decider::leaving_velocity(std::size_t c, const MotionJet& free, const Instant& instant) const {
  const Contact& contact = model_.contacts[c];
  const double rounding = free.noise[0].vn + rounding_of(contact.normal, instant.v);
  const double pull = -free.motion[0].an;
  if (!(pull > 0.0)) return rounding;
  return rounding + std::max({instant.resolution * pull, std::sqrt(2.0 * pull * free.noise[0].gap),
                              contact.capture_velocity.value_or(capture_velocity_)});
}

/// After an impact: sliders that stick rigidly slip as soon as their slip rate is not zero. Where a dashpot
/// lets N jump, T stays continuous: the element sticks at it unless its limit has fallen below.
void Decider::follow_velocity(const Instant& instant, const Forcing& after,
                              const std::vector<ContactMotion>& before, Mode& mode) const {
  for (std::size_t c = 0; c < mode.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    if (contact.tangential_stiffness && contact.normal_damping > 0.0 && slip_sign(mode[c].state) != 0)
      mode[c] = {State::stick, before[c].ut - before[c].T / *contact.tangential_stiffness};
    if (contact.law != Law::slider || !contact.sticks_rigidly() || mode[c].state == State::open) continue;
    const double vt = contact.tangent.dot(instant.v) - after.surface(c, instant.t, 1);
    if (std::abs(vt) > rounding_of_slide(c, after, instant))
      mode[c].state = vt > 0.0 ? State::slip_plus : State::slip_minus;
  }
}

/// What counts as zero becomes zero, for all contacts at once: setting one to zero moves the others.
void Decider::settle_resting(Instant& instant, const Forcing& forcing,
                             const std::vector<std::size_t>& touching,
                             const std::vector<Participant>& participants) const {
  std::vector<Fixed> fixed;
  for (std::size_t i = 0; i < touching.size(); ++i) {
    const Contact& contact = model_.contacts[touching[i]];
    const auto who = std::find_if(participants.begin(), participants.end(),
                                  [&](const Participant& p) { return p.contact == touching[i]; });
    if (who == participants.end()) continue;
    const auto row = static_cast<Eigen::Index>(2 * i);
    fixed.push_back({row, &contact.normal, 0.0});
    if (contact.has_friction() && !who->slipping)
      fixed.push_back({row + 1, &contact.tangent, forcing.surface(touching[i], instant.t, 1)});
  }
  settle(delassus(model_, expander_, touching), fixed, instant.v);
}

/// Impacts where there are any, then the states. Returns why it cannot, or nothing.
std::string Decider::decide_jointly(Instant& instant, const Forcing& after, Joint& joint, Decision& decision,
                                    const std::vector<MotionJet>& jets, const std::vector<Failure>& failed,
                                    Mode& mode) const {
  const auto fired = [&](std::size_t c, Guard guard) {
    return std::any_of(instant.fired.begin(), instant.fired.end(),
                       [&](const Fired& f) { return f.contact == c && f.guard == guard; });
  };
  const auto is_zero = [&](double value, double noise, double rate) {
    return std::abs(value) <= noise + instant.resolution * std::abs(rate);
  };
  const Mode old = mode;
  std::vector<std::size_t> touching;
  bool impact = false, apart = false;
  for (std::size_t c = 0; c < mode.size(); ++c) {
    if (model_.contacts[c].law != Law::rigid) continue;
    const ContactMotion &m = jets[c].motion[0], &noise = jets[c].noise[0];
    // One whose gap has become negative touches, too: it fell with others, within the resolution of the
    // clock.
    const bool fell =
        std::any_of(failed.begin(), failed.end(), [&](const Failure& f) { return f.contact == c; });
    if (mode[c].state == State::open && !fired(c, Guard::closing) && !fell &&
        !is_zero(m.gap, noise.gap, m.vn))
      continue;
    touching.push_back(c);
    joint.touching[c] = true;
    apart = apart || m.gap != 0.0;
    impact = impact || (mode[c].state == State::open && m.vn < 0.0 && !is_zero(m.vn, noise.vn, m.an));
  }
  if (apart && !impact) instant.u = impacts_.close(mode, touching, instant.u);
  if (impact) {
    const Impact result = impacts_.solve(after, instant.t, mode, touching, instant.u, instant.v);
    if (!result.solved) return result.reason;
    instant.u = result.u;
    instant.v = result.v;
    joint.stays.assign(mode.size(), false);
    joint.rests.assign(mode.size(), false);
    decision.impact_loss += result.loss;
    decision.impact_surface_work += result.surface_work;
    decision.impact_gains = decision.impact_gains || result.gains;
    if (decision.impulses.empty()) decision.impulses.resize(mode.size());
    for (const std::size_t c : touching) {
      Impulse& sum = decision.impulses[c];
      sum.hit = sum.hit || result.impulses[c].hit;
      sum.normal += result.impulses[c].normal;
      sum.tangent += result.impulses[c].tangent;
      sum.rests = result.impulses[c].rests;
      sum.sticks = result.impulses[c].sticks;
    }
    follow_velocity(instant, after, decision.before, mode);
  }
  // Without forces at all that touch: how fast each is pulled back.
  for (const std::size_t c : touching) mode[c] = {State::open, 0.0};
  if (!expander_.set(mode)) return "the equations of motion without rigid contacts are singular";
  std::vector<MotionJet> free;
  (void)expander_.expand(after, instant.t, instant.u, instant.v, free);
  std::vector<Participant> participants;
  for (const std::size_t c : touching) {
    const Contact& contact = model_.contacts[c];
    const ContactMotion &m = free[c].motion[0], &noise = free[c].noise[0];
    const Impulse struck = impact ? decision.impulses[c] : Impulse{};
    if (!struck.rests && !joint.stays[c] && m.vn > leaving_velocity(c, free[c], instant)) continue;
    joint.stays[c] = true;
    const double zero = noise.vt + rounding_of_slide(c, after, instant) + instant.resolution * std::abs(m.at);
    const bool rests =
        struck.sticks || joint.rests[c] || (!impact && fired(c, Guard::sliding)) || std::abs(m.vt) <= zero;
    Participant who{c};
    who.slipping = contact.has_friction() && !rests;
    who.sign = m.vt > 0.0 ? 1 : -1;
    who.sliding_friction = sliding_friction(contact, rests ? 0.0 : std::abs(m.vt));
    who.kinetic = joint.kinetic[c];
    participants.push_back(who);
  }
  settle_resting(instant, after, touching, participants);
  for (std::size_t c = 0; joint.sliders && c < mode.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    if (contact.law != Law::slider || !contact.sticks_rigidly() || !decision.visited[c]) continue;
    Participant who{c};
    who.sliding_friction = sliding_friction(contact, 0.0);
    who.kinetic = joint.kinetic[c];
    participants.push_back(who);
  }
  std::string reason = JointDecision(model_, expander_).decide(instant, after, participants, old, mode);
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
  Joint joint(count);

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
  bool blurred = false;
  for (bool open = instant.start;; open = false) {
    const std::vector<Failure> failed = failures(jets, mode, instant, first, joint.touching);
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
        if (f.guard == Guard::sliding && joint.decided[f.contact] &&
            starts_at_zero(f.form, jets[f.contact], instant))
          joint.rests[f.contact] = true;
      } else {
        mode[f.contact] = next_state(contact, mode[f.contact], f.guard, jets[f.contact]);
      }
    }
    if (jointly) {
      if (std::string why = decide_jointly(instant, after, joint, decision, jets, failed, mode);
          !why.empty()) {
        decision.reason = failed.empty() ? why : fmt::format("{} (after {})", why, describe(failed));
        return decision;
      }
    }
    std::vector<Memory> now = states(mode);
    if (!open && std::find(seen.begin(), seen.end(), now) != seen.end() && decision.impulses.empty()) {
      if (!blurred) {  // what is zero was told by one sample of rounding, and by the clock: perhaps too
                       // sharply
        blurred = true;
        instant.blur = unlucky;
        instant.resolution *= unlucky;
        seen.clear();
      } else if (joint.sliders) {
        decision.reason =
            fmt::format("no combination of states is consistent; guards that fail: {}", describe(failed));
        return decision;
      } else {
        joint.sliders = true;
      }
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
        const bool touches = joint.touching[c] && guard.kind == Guard::closing;
        start.at_zero = touches || starts_at_zero(guard.form, jets[c], instant);
        start.noise = guard.form.magnitude(jets[c].noise[0]);
        const int order = sign_after(guard.form, jets[c], instant, touches ? 1 : 0).order;
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
