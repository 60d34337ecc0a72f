// Decider, its rigid part: contacts that touch, from velocities to states.
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/friction.hpp"
#include "decide/levels.hpp"

namespace signorini {
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
      mode[c] = {State::stick, slip_of(contact, before[c])};
    if (contact.has_gap() || !contact.sticks_rigidly() || mode[c].is_open()) continue;
    const double vt = contact.tangent.dot(instant.v) - after.surface(c, instant.t, 1);
    if (std::abs(vt) > rounding_of_slide(c, after, instant)) mode[c].state = slip_along(vt);
  }
}

/// What counts as zero becomes zero, for all contacts at once: setting one to zero moves the others.
void Decider::settle_resting(Instant& instant, const Forcing& forcing, const ModeSystem& free,
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
  if (!settled(fixed, instant.v)) settle(delassus(model_, free, touching), fixed, instant.v);
}

bool Decider::has_rigid(const std::vector<std::size_t>& group) const {
  return std::any_of(group.begin(), group.end(),
                     [&](std::size_t c) { return model_.contacts[c].takes_impulses(); });
}

/// Of contacts that move each other: impacts where there are any, then the states. Returns why it cannot, or
/// nothing.
std::string Decider::decide_jointly(Instant& instant, const Forcing& after, Joint& joint, Decision& decision,
                                    const std::vector<MotionJet>& jets, const std::vector<Failure>& failed,
                                    const std::vector<std::size_t>& group, Mode& mode) {
  const auto is_zero = [&](double value, double noise, double rate) {
    return std::abs(value) <= noise + instant.resolution * std::abs(rate);
  };
  const Mode old = mode;
  std::vector<std::size_t> touching;
  bool impact = false, apart = false;
  for (const std::size_t c : group) {
    if (!model_.contacts[c].takes_impulses()) continue;
    const ContactMotion &m = jets[c].motion[0], &noise = jets[c].noise[0];
    // One whose gap has become negative touches, too: it fell with others, within the resolution of the
    // clock.
    const bool fell =
        std::any_of(failed.begin(), failed.end(), [&](const Failure& f) { return f.contact == c; });
    if (mode[c].is_open() && !instant.has_fired(c, Guard::closing) && !fell &&
        !is_zero(m.gap, noise.gap, m.vn))
      continue;
    touching.push_back(c);
    joint.touching[c] = true;
    apart = apart || m.gap != 0.0;
    impact = impact || (mode[c].is_open() && m.vn < 0.0 && !is_zero(m.vn, noise.vn, m.an));
  }
  if (apart && !impact) instant.u = impacts_.close(mode, touching, instant.u);
  if (impact) {
    const Impact result = impacts_.solve(after, instant.t, mode, touching, instant.u, instant.v);
    if (!result.solved) return result.reason;
    instant.u = result.u;
    instant.v = result.v;
    for (const std::size_t c : group) joint.stays[c] = joint.rests[c] = false;
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
  const ModeSystemPtr system = systems_.of(mode);
  if (!system) return "the equations of motion without rigid contacts are singular";
  std::vector<MotionJet> free;
  const Jet free_jet = jets_.make(system, after, instant.t, instant.u, instant.v, free);
  std::vector<Participant> participants;
  for (const std::size_t c : touching) {
    const Contact& contact = model_.contacts[c];
    const ContactMotion &m = free[c].motion[0], &noise = free[c].noise[0];
    const Impulse struck = impact ? decision.impulses[c] : Impulse{};
    if (!struck.rests && !joint.stays[c] && m.vn > leaving_velocity(c, free[c], instant)) continue;
    joint.stays[c] = true;
    const double zero = noise.vt + rounding_of_slide(c, after, instant) + instant.resolution * std::abs(m.at);
    const bool rests = struck.sticks || joint.rests[c] || (!impact && instant.has_fired(c, Guard::sliding)) ||
                       std::abs(m.vt) <= zero;
    Participant who{c};
    who.slipping = contact.has_friction() && !rests;
    who.sign = m.vt > 0.0 ? 1 : -1;
    who.sliding_friction = sliding_friction(contact, rests ? 0.0 : std::abs(m.vt));
    who.kinetic = joint.kinetic[c];
    participants.push_back(who);
  }
  const Vector moving = instant.v;
  settle_resting(instant, after, *free_jet.system, touching, participants);
  // A contact that a neighbour's hit lifts slower than capture_velocity is stopped: the energy is lost.
  decision.impact_loss += 0.5 * (moving - instant.v).dot(model_.mass * (moving + instant.v));
  for (const std::size_t c : group) {
    if (!joint.sliders) break;
    const Contact& contact = model_.contacts[c];
    if (contact.has_gap() || !contact.sticks_rigidly() || !decision.visited[c]) continue;
    Participant who{c};
    who.sliding_friction = sliding_friction(contact, 0.0);
    who.kinetic = joint.kinetic[c];
    participants.push_back(who);
  }
  std::string reason = JointDecision(systems_, jets_).decide(instant, after, participants, old, mode);
  for (const Participant& who : participants) {
    joint.decided[who.contact] = true;
    if (mode[who.contact] != old[who.contact]) decision.visited[who.contact] = true;
  }
  return reason;
}

}  // namespace signorini
