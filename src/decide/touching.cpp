#include "decide/touching.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/rounding.hpp"

#include "contact/friction.hpp"
#include "contact/motion.hpp"
#include "decide/places.hpp"

namespace signorini {
namespace {

/// Of the scale of velocities: motions that differ by more are not one that rounding has split. sqrt(eps): no flow of
/// an engine loses half of its digits.
constexpr double half_of_digits = 0x1p-26;
/// Turns of hits at one instant; capture_velocity ends a sequence of rebounds long before, unless e is nearly one.
constexpr int most_turns = 1000;

double norm_of(const Combination& form) {
  double squared = 0.0;
  for (const auto& [dof, factor] : form.terms) squared += factor * factor;
  return std::sqrt(squared);
}

/// The rounding of a form of the velocities, |form| |v| whatever the angle between them. Where all of them are
/// held at zero, what is left of them is the rounding of corrections, square against the motion of the rest.
double rounding_of(const Combination& form, const Vector& v) {
  const double rest = rounding::eps * v.norm();
  double v_squared = 0.0;
  for (const auto& [dof, factor] : form.terms) v_squared += v[dof] * v[dof];
  return rounding::of_many * norm_of(form) * (std::sqrt(v_squared) + rest);
}

/// The size of all velocities; rotations are of another unit, and left out.
double speed_of(const Model& model, const Vector& v) {
  double squared = 0.0;
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (!model.dofs[static_cast<std::size_t>(i)].rotation) squared += v[i] * v[i];
  return std::sqrt(squared);
}

/// -sum of impulse times mean velocity, of what was captured since `before`. twice: velocities before and after, added.
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

void Findings::capture(const Model& model, const std::vector<std::size_t>& contacts,
                       const Eigen::VectorXd& impulses) {
  if (impulses.size() == 0) return;
  if (captures.size() == 0) captures.setZero(model.force_count());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    captures.data()[model.layout.normal(contacts[i])] += impulses[normal_place(i)];
    captures.data()[model.layout.tangent(contacts[i])] += impulses[tangent_place(i)];
  }
}

void Findings::capture(const Eigen::VectorXd& impulses) {
  if (impulses.size() == 0) return;
  if (captures.size() == 0) captures.setZero(impulses.size());
  captures += impulses;
}

Touching::Touching(ModeSystems& systems, JetMaker& jets, double capture_velocity)
    : model_(systems.model()),
      systems_(systems),
      jets_(jets),
      capture_velocity_(capture_velocity),
      impacts_(systems, capture_velocity),
      levels_(systems, jets) {}

/// The rounding of t.v less the velocity of the surface, and what rests besides; at the start no less than that of
/// the scene's velocities.
double Touching::rounding_of_slide(std::size_t c, const Forcing& forcing, const Instant& instant) const {
  const double given = instant.start ? rounding::of_few * model_.scales.velocity : 0.0;
  return given + rounding_of(model_.contacts[c].tangent, instant.v) +
         rounding::of_many * std::abs(forcing.surface(c, instant.t, 1)) +
         forcing.surface_rounding(c, instant.t) + instant.slow;
}

double Touching::slowest_flight(std::size_t c) const {
  return model_.contacts[c].capture_velocity.value_or(capture_velocity_);
}

/// A contact with g = 0 that is pulled back stays where its flight would be shorter than the clock resolves.
/// It is low where the lift is below capture_velocity, or the flight lower than the rounding of its gap and
/// nobody knows such flights. fell: its acceleration towards the ground before; where all that touch fall freely
/// together nothing seems to pull it back.
Touching::Departure Touching::departure(std::size_t c, const MotionJet& free, double fell,
                                        const Instant& instant) const {
  const Contact& contact = model_.contacts[c];
  const ContactMotion &m = free.motion[0], &noise = free.noise[0];
  const double pull = std::max(-m.an, fell);
  // What stands still moves by the rounding of its equilibrium, not of its velocity.
  const double rounding =
      instant.blur * noise.vn + rounding_of(contact.normal, instant.v) + instant.resolution * std::abs(pull);
  if (!(pull > 0.0)) return {m.vn <= rounding ? Departure::How::stays : Departure::How::leaves};
  double low = slowest_flight(c);
  if (!instant.knows_low_flights)
    low = std::max(low, std::sqrt(2.0 * pull * std::max(noise.gap, std::abs(m.gap))));
  const double ratio = m.vn / (rounding + low);
  if (m.vn <= rounding) return {Departure::How::stays, ratio};
  return {m.vn <= rounding + low ? Departure::How::low : Departure::How::leaves, ratio};
}

/// Does a dashpot let the compression of a contact jump up, by n . (v+ - v-)? What a solve leaves of the velocities
/// of those that no impulse reaches is rounding of all that jump.
bool Touching::presses_harder(std::size_t c, const Vector& before, const Vector& after) const {
  const Contact& contact = model_.contacts[c];
  if (!(contact.normal_damping > 0.0)) return false;
  // Of an elimination: what a hit does far from it, 0.3 of the last node's at each node of a beam, is no jump where it is
  // that small.
  const double rounding = rounding_of(contact.normal, before) + rounding_of(contact.normal, after) +
                          4.0 * rounding::of_elimination * norm_of(contact.normal) *
                              (speed_of(model_, before) + speed_of(model_, after));
  return gap_rate(contact, after) - gap_rate(contact, before) < -rounding;
}

/// After an impact: sliders that stick rigidly slip as soon as their slip rate is not zero. Where a dashpot lets
/// |N| jump up T stays continuous, below its new limit: the element sticks at it. Where |N| jumps down T follows its
/// limit; where N does not jump the slip goes on as long as its own guard holds.
void Touching::follow_velocity(const Instant& instant, const Vector& before, const Forcing& after,
                               const Block& block, const std::vector<ContactMotion>& motion,
                               Mode& mode) const {
  for (const std::size_t c : block) {
    const Contact& contact = model_.contacts[c];
    if (contact.tangential_stiffness && slip_sign(mode[c].state) != 0 && presses_harder(c, before, instant.v))
      mode[c] = {State::stick, slip_of(contact, motion[c])};
    if (!contact.holds_tangent_only() || mode[c].is_open()) continue;
    const double vt = along_surface(contact, instant.v, after.surface(c, instant.t, 1));
    // As in presses_harder: what stuck is at rest but for what the solve has left of all that jumps.
    const double of_jump =
        slip_sign(mode[c].state) == 0
            ? rounding::of_elimination * norm_of(contact.tangent) * speed_of(model_, instant.v - before)
            : 0.0;
    if (std::abs(vt) > of_jump + rounding_of_slide(c, after, instant)) mode[c].state = slip_along(vt);
  }
}

/// What counts as zero becomes zero, for all contacts at once: setting one to zero moves the others.
/// False: they were zero already.
bool Touching::settle_resting(Instant& instant, const Forcing& forcing, const ModeSystem& free,
                              const Met& met, Findings& found) const {
  std::vector<Fixed> fixed;
  for (std::size_t i = 0; i < met.contacts.size(); ++i) {
    const std::size_t c = met.contacts[i];
    const Contact& contact = model_.contacts[c];
    const auto who = std::find_if(found.participants.begin(), found.participants.end(),
                                  [&](const Participant& p) { return p.contact == c; });
    if (who == found.participants.end()) continue;
    const Eigen::Index row = normal_place(i);
    fixed.push_back({row, &contact.normal, 0.0});
    found.known[c].closing.zeros = 2;
    if (!contact.has_friction() || who->slipping) continue;
    fixed.push_back({row + 1, &contact.tangent, forcing.surface(c, instant.t, 1)});
    found.known[c].sliding.zeros = 1;
  }
  if (settled(fixed, instant.v)) return false;
  const Eigen::VectorXd impulses = settle(delassus(model_, free, met.contacts), fixed, instant.v);
  found.capture(with_reactions(model_, free, met.contacts, impulses));
  return true;
}

/// Where others were set to zero a contact may slide the other way. True: one of them rests now.
bool Touching::slide_anew(const Instant& instant, const Forcing& forcing, const Met& met,
                          Findings& found) const {
  bool rests = false;
  for (Participant& who : found.participants) {
    const std::size_t c = who.contact;
    if (!who.slipping || !std::binary_search(met.contacts.begin(), met.contacts.end(), c)) continue;
    const Contact& contact = model_.contacts[c];
    const double vt = along_surface(contact, instant.v, forcing.surface(c, instant.t, 1));
    who.sign = vt > 0.0 ? 1 : -1;
    who.sliding_friction = sliding_friction(contact, std::abs(vt));
    if (std::abs(vt) > rounding_of_slide(c, forcing, instant)) continue;
    who.slipping = false;
    rests = true;
  }
  return rests;
}

/// What rounding has carried into g and g'. da, that of g'', gives dv = t da in all velocities since the
/// beginning and du = t^2/2 da in displacements. When the contact touched last g and g' were known exactly;
/// since then, for the time s, dv has moved g, da g', and du both through the stiffness of the structure: by
/// du min(1, (w s)^2/2) and du w min(1, w s), w the highest frequency. That is a bound, and where it is of no use, in
/// stiff structures after long times, velocities that differ by half_of_digits of their scale are others all the same.
Touching::Carried Touching::carried_by(std::size_t c, double da, const Instant& instant) const {
  if (instant.touched.empty()) return {};
  const double t = instant.t, s = t - instant.touched[c], w = model_.omega_max, du = 0.5 * t * t * da;
  const double angle = std::min(1.0, w * s);
  const double most = half_of_digits * model_.scales.velocity;
  return {std::min(t * da * s + du * 0.5 * angle * angle, most * s), std::min(da * s + du * w * angle, most)};
}

/// A flight begins with g = 0, so what it has risen since is known to the sum that g is, of data that are doubles;
/// where it never touched the data themselves are known to some roundings.
double Touching::rounding_of_gap(std::size_t c, double of_data, const Instant& instant) const {
  const bool flew = !instant.touched.empty() && instant.touched[c] > 0.0;
  const Contact& contact = model_.contacts[c];
  return flew ? rounding::of_few * (contact.normal.magnitude(instant.u) + std::abs(contact.gap)) : of_data;
}

Touching::Met Touching::meet(const Instant& instant, const std::vector<MotionJet>& jets,
                             const std::vector<Failure>& failed, const Block& block, const Mode& mode) const {
  const auto is_zero = [&](double value, double noise, double rate) {
    return std::abs(value) <= noise + instant.resolution * std::abs(rate);
  };
  // Given motions that are nothing but rounding tell no more of a gap than those of the scene's size.
  const double given = instant.start ? rounding::of_few * model_.scales.displacement : 0.0;
  const double given_rate = instant.start ? rounding::of_few * model_.scales.velocity : 0.0;
  Met met;
  int together = 0;
  bool doubtful = false;
  for (const std::size_t c : block) {
    if (!model_.contacts[c].takes_impulses()) continue;
    const ContactMotion &m = jets[c].motion[0], &noise = jets[c].noise[0];
    const bool open = mode[c].is_open();
    const Carried carried = carried_by(c, noise.an, instant);
    const double known = rounding_of_gap(c, noise.gap, instant) + given;
    // Whatever has been carried there, what closes faster than a rebound that would not rest is a hit.
    const double unsure = std::min(carried.rate + instant.resolution * std::abs(m.an), slowest_flight(c));
    Approach a{c, 0.0, m.vn, noise.vn + given_rate + slowest_flight(c), noise.vn + unsure + given_rate, open};
    // One whose gap has become negative touches, too: it fell with others, within the resolution of the
    // clock.
    const bool fell =
        std::any_of(failed.begin(), failed.end(), [&](const Failure& f) { return f.contact == c; });
    const bool touches = !open || instant.has_fired(c, Guard::closing) || std::abs(m.gap) <= known;
    const bool split = !touches && (fell || std::abs(m.gap) <= known + carried.gap) &&
                       lands_alike(a, instant, jets, failed, block);
    const bool comes = is_zero(m.gap, known, m.vn);
    const bool above = !touches && !split && !comes;
    if (above && !fell) continue;
    if (!touches && !split) a.gap = std::max(m.gap, 0.0);
    met.unresolved = met.unresolved || (above && m.gap > 0.0) || (split && !comes);
    met.contacts.push_back(c);
    met.approaches.push_back(a);
    met.apart = met.apart || m.gap != 0.0;
    met.hit = met.hit || a.closes();
    // Hit together by what its data are known to: they do not tell whether it is.
    const double own = rounding::of_few * (model_.contacts[c].normal.magnitude(instant.u) +
                                           std::abs(model_.contacts[c].gap) + instant.t * std::abs(m.vn));
    if (!a.closes() || a.gap > 0.0) continue;
    ++together;
    doubtful = doubtful || (!instant.has_fired(c, Guard::closing) && std::abs(m.gap) > own + given);
  }
  met.unresolved = met.unresolved || (together > 1 && doubtful);
  return met;
}

/// Does it move like one that falls now, but for what rounding may have made of both? Or not at all?
bool Touching::lands_alike(const Approach& a, const Instant& instant, const std::vector<MotionJet>& jets,
                           const std::vector<Failure>& failed, const Block& block) const {
  if (std::abs(a.rate) <= a.rest) return true;
  const double alike = a.hit + half_of_digits * model_.scales.velocity;
  return std::any_of(block.begin(), block.end(), [&](std::size_t c) {
    const bool falls =
        instant.has_fired(c, Guard::closing) ||
        std::any_of(failed.begin(), failed.end(), [&](const Failure& f) { return f.contact == c; });
    const double apart = std::abs(jets[c].motion[0].vn - a.rate);
    return c != a.contact && falls && model_.contacts[c].takes_impulses() && apart <= alike;
  });
}

/// Turn by turn, until none closes.
Refusal Touching::strike(Instant& instant, const Forcing& forcing, const Met& met, const Block& block,
                         Findings& found, Decision& decision, Mode& mode) {
  std::vector<Approach> all = met.approaches;
  for (int turn = 0; turn < most_turns; ++turn) {
    const Block struck = next_turn(all);
    if (struck.empty()) return {};
    if (Refusal why = strike_once(instant, forcing, struck, block, found, decision, mode)) return why;
    for (Approach& a : all) {
      a.rate = gap_rate(model_.contacts[a.contact], instant.v);
      a.rest = std::max(
          a.rest, slowest_flight(a.contact) + rounding_of(model_.contacts[a.contact].normal, instant.v));
      a.hit = a.rest;
      if (!(a.rate > a.rest)) continue;
      mode[a.contact] = {State::open, 0.0};
      a.open = true;
      // One that had come to rest is thrown off; how one that rebounds itself was hit stays as it is.
      if (Impulse& sum = decision.impulses[a.contact]; sum.rests) sum.rests = sum.sticks = false;
    }
  }
  return {
      Refusal::Kind::endless,
      fmt::format("{} hits one after the other at one instant do not end; a greater capture_velocity ends "
                  "rebounds sooner",
                  most_turns),
      met.contacts};
}

/// One turn.
Refusal Touching::strike_once(Instant& instant, const Forcing& forcing, const Block& struck,
                              const Block& block, Findings& found, Decision& decision, Mode& mode) {
  const Impact result = impacts_.solve(forcing, instant.t, mode, struck, instant.v);
  if (result.refusal) return result.refusal;
  const Vector before = std::exchange(instant.v, result.v);
  found.capture(model_, struck, result.settled);
  for (const std::size_t c : block) {
    found.stays[c] = found.rests[c] = false;
    found.known[c].sliding = {};
  }
  decision.impact_loss += result.loss;
  decision.impact_surface_work += result.surface_work;
  decision.impact_gains = decision.impact_gains || result.gains;
  if (decision.impulses.empty()) decision.impulses.resize(mode.size());
  const int turn = decision.blows.empty() ? 1 : decision.blows.back().turn + 1;
  for (const std::size_t c : struck) {
    Impulse& sum = decision.impulses[c];
    decision.blows.push_back({c, turn, result.impulses[c].normal, result.impulses[c].tangent});
    sum.hit = sum.hit || result.impulses[c].hit;
    sum.normal += result.impulses[c].normal;
    sum.tangent += result.impulses[c].tangent;
    sum.rests = result.impulses[c].rests;
    sum.sticks = result.impulses[c].sticks;
    sum.rebound = result.impulses[c].rebound;
  }
  follow_velocity(instant, before, forcing, block, decision.before, mode);
  return {};
}

/// Those that do not leave. free: the motion without forces at all that touch.
void Touching::add_staying(const Instant& instant, const Forcing& forcing, const Met& met,
                           const std::vector<MotionJet>& free, const Decision& decision,
                           Findings& found) const {
  for (const std::size_t c : met.contacts) {
    const Contact& contact = model_.contacts[c];
    const ContactMotion &m = free[c].motion[0], &noise = free[c].noise[0];
    const Impulse struck = met.hit ? decision.impulses[c] : Impulse{};
    if (!struck.rests && !found.stays[c]) {
      using How = Departure::How;
      const bool open = instant.mode[c].is_open();
      const double fell = open ? -decision.before[c].an : 0.0;
      const auto [how, ratio] = departure(c, free[c], fell, instant);
      found.departures[c] = ratio;
      if (how == How::leaves || (how == How::low && instant.low_flights)) continue;
      found.grounded = found.grounded || how == How::low;
      found.unresolved = found.unresolved || (slowest_flight(c) > 0.0 && m.vn > slowest_flight(c));
      found.slowest = std::max(found.slowest, m.vn);
    }
    found.stays[c] = true;
    const double zero =
        noise.vt + rounding_of_slide(c, forcing, instant) + instant.resolution * std::abs(m.at);
    const bool rests = struck.sticks || found.rests[c] ||
                       (!met.hit && instant.has_fired(c, Guard::sliding)) || std::abs(m.vt) <= zero;
    Participant who{c};
    who.slipping = contact.has_friction() && !rests;
    who.sign = m.vt > 0.0 ? 1 : -1;
    who.sliding_friction = sliding_friction(contact, rests ? 0.0 : std::abs(m.vt));
    who.kinetic = found.kinetic[c];
    who.bears_limit = found.bears_limit[c];
    found.participants.push_back(who);
  }
}

/// What others that rest hold rests with them, whatever rounding has left of its slip: feet of one body.
void Touching::rest_together(const Instant& instant, const Forcing& forcing, const Mode& mode,
                             Findings& found) const {
  Mode held = mode;
  for (const Participant& who : found.participants)
    held[who.contact].state = !model_.contacts[who.contact].has_friction() ? State::closed
                              : who.slipping                               ? slip_along(who.sign)
                                                                           : State::stick;
  for (Participant& who : found.participants) {
    const std::size_t c = who.contact;
    if (!who.slipping || !systems_.held_by_others(c, held, forcing, instant.t)) continue;
    const double vt = along_surface(model_.contacts[c], instant.v, forcing.surface(c, instant.t, 1));
    if (std::abs(vt) > slowest_flight(c) + rounding::of_many * model_.scales.velocity) continue;
    who.slipping = false;
    who.sliding_friction = sliding_friction(model_.contacts[c], 0.0);
    held[c].state = State::stick;
  }
}

/// Of those that hold one motion with others, of which one has let go or has come to rest: all that are at rest.
std::vector<std::size_t> Touching::sharing(const Instant& instant, const Forcing& forcing, const Mode& mode,
                                           const Decision& decision) const {
  std::vector<std::size_t> at_rest;
  for (const std::vector<std::size_t>& group : systems_.sharing()) {
    if (std::none_of(group.begin(), group.end(), [&](std::size_t c) { return decision.visited[c]; }))
      continue;
    Mode held = mode;
    const auto stops = [&](std::size_t c) {
      if (mode[c].state == State::stick || instant.has_fired(c, Guard::sliding)) return true;
      const double vt = along_surface(model_.contacts[c], instant.v, forcing.surface(c, instant.t, 1));
      const double held_too = systems_.held_by_others(c, held, forcing, instant.t)
                                  ? slowest_flight(c) + rounding::of_many * model_.scales.velocity
                                  : 0.0;
      return std::abs(vt) <= std::max(rounding_of_slide(c, forcing, instant), held_too);
    };
    for (int round = 0; round < 2; ++round)  // what has stopped holds others
      for (const std::size_t c : group)
        if (model_.contacts[c].normal_force_given() && !mode[c].is_open() && stops(c))
          held[c].state = State::stick;
    std::copy_if(group.begin(), group.end(), std::back_inserter(at_rest), [&](std::size_t c) {
      return model_.contacts[c].normal_force_given() && held[c].state == State::stick;
    });
  }
  return at_rest;
}

/// Sliders whose friction has let go or has stopped them, where they join; and those that a hit has stopped.
void Touching::add_sliders(const Instant& instant, const Forcing& forcing, const Met& met, const Block& block,
                           const Mode& mode, const Decision& decision, Findings& found) const {
  const std::vector<std::size_t> together = sharing(instant, forcing, mode, decision);
  for (const std::size_t c : block) {
    const Contact& contact = model_.contacts[c];
    if (!contact.holds_tangent_only()) continue;
    const bool shares = std::find(together.begin(), together.end(), c) != together.end();
    const double vt = along_surface(contact, instant.v, forcing.surface(c, instant.t, 1));
    const bool stopped =
        met.hit && slip_sign(mode[c].state) != 0 && std::abs(vt) <= rounding_of_slide(c, forcing, instant);
    if (!stopped && !shares && !(found.sliders && decision.visited[c])) continue;
    Participant who{c};
    who.sliding_friction = sliding_friction(contact, 0.0);
    who.kinetic = found.kinetic[c];
    who.bears_limit = found.bears_limit[c];
    if (shares) found.known[c].sliding.zeros = 1;
    found.known[c] = found.known[c].of_motion();
    found.participants.push_back(who);
  }
}

/// Sliders that stick rigidly and would be held besides: what must be found may need them to let go. False:
/// there are none.
bool Touching::add_sticking(const std::vector<Block>& blocks, const Mode& mode, Findings& found) const {
  std::vector<Participant> all;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    std::copy_if(found.participants.begin(), found.participants.end(), std::back_inserter(all),
                 [&](const Participant& who) { return who.block == b; });
    for (const std::size_t c : blocks[b]) {
      const Contact& contact = model_.contacts[c];
      const bool takes_part =
          std::any_of(all.begin(), all.end(), [&](const Participant& who) { return who.contact == c; });
      if (!contact.holds_tangent_only() || mode[c].state != State::stick || takes_part) continue;
      Participant who{c};
      who.sliding_friction = sliding_friction(contact, 0.0);
      who.kinetic = found.kinetic[c];
      who.bears_limit = found.bears_limit[c];
      who.block = b;
      all.push_back(who);
    }
  }
  const bool some = all.size() > found.participants.size();
  if (some) found.participants = std::move(all);
  return some;
}

/// Where no motion goes on, several do, or rows are dependent, as long as sliders beside are held, they are
/// decided with the rest.
Refusal Touching::solve_levels(const Instant& instant, const Forcing& forcing,
                               const std::vector<Block>& blocks, const Mode& old, Findings& found,
                               Mode& mode) {
  const Mode held = mode;
  const std::vector<KnownGuards> known = found.known;
  Refusal refusal = levels_.decide(instant, forcing, found.participants, old, mode, found.known);
  const bool painleve = refusal.kind == Refusal::Kind::paradox || refusal.kind == Refusal::Kind::ambiguous;
  const bool dependent = refusal ? refusal.kind == Refusal::Kind::dependent : systems_.of(mode) == nullptr;
  if (!(painleve || dependent) || !add_sticking(blocks, held, found)) return refusal;
  mode = held;
  found.known = known;
  for (const Participant& who : found.participants)
    if (model_.contacts[who.contact].normal_force_given())
      found.known[who.contact] = known[who.contact].of_motion();
  const Refusal together = levels_.decide(instant, forcing, found.participants, old, mode, found.known);
  return together ? refusal : Refusal{};
}

Refusal Touching::decide(Instant& instant, const Forcing& forcing, const std::vector<MotionJet>& jets,
                         const std::vector<Failure>& failed, const std::vector<Block>& blocks,
                         Findings& found, Decision& decision, Mode& mode) {
  const Mode old = mode;
  std::vector<Met> all;
  for (const Block& block : blocks) {
    const Met& met = all.emplace_back(meet(instant, jets, failed, block, mode));
    found.hit = found.hit || met.hit;
    found.unresolved = found.unresolved || met.unresolved;
    for (const std::size_t c : met.contacts) {
      found.known[c] = {};
      found.known[c].touches = true;
      found.known[c].closing.zeros = 1;
    }
  }
  for (std::size_t b = 0; b < all.size(); ++b) {
    const Met& met = all[b];
    if (met.hit)
      if (Refusal why = strike(instant, forcing, met, blocks[b], found, decision, mode)) return why;
    if (met.apart) instant.u = impacts_.close(mode, met.contacts, instant.u);
  }
  for (const Met& met : all)
    for (const std::size_t c : met.contacts) mode[c] = {State::open, 0.0};
  const ModeSystemPtr system = systems_.of(mode);
  if (!system)
    return {Refusal::Kind::singular, "the equations of motion without rigid contacts are singular", {}};
  Block touching;
  for (const Met& met : all) touching.insert(touching.end(), met.contacts.begin(), met.contacts.end());
  std::vector<MotionJet> free;
  const Jet free_jet = jets_.make(system, forcing, instant.t, instant.u, instant.v, free);
  found.participants.clear();
  const Vector moving = instant.v;
  const Eigen::VectorXd captured = found.captures;
  std::size_t placed = 0;
  for (std::size_t b = 0; b < all.size(); ++b) {
    add_staying(instant, forcing, all[b], free, decision, found);
    rest_together(instant, forcing, mode, found);
    while (settle_resting(instant, forcing, *free_jet.system, all[b], found))  // ends: one more rests
      if (!slide_anew(instant, forcing, all[b], found)) break;
    add_sliders(instant, forcing, all[b], blocks[b], mode, decision, found);
    for (; placed < found.participants.size(); ++placed) found.participants[placed].block = b;
  }
  // A contact that a neighbour's hit lifts slower than capture_velocity is stopped: the energy is lost.
  decision.impact_loss += loss_of(model_, touching, captured, found.captures, moving + instant.v);
  Refusal refusal = solve_levels(instant, forcing, blocks, old, found, mode);
  for (const Participant& who : found.participants) {
    found.decided[who.contact] = true;
    if (mode[who.contact] != old[who.contact]) decision.visited[who.contact] = true;
  }
  return refusal;
}

}  // namespace signorini
