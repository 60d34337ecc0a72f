#include "decide/decide.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "model/assembly/parts.hpp"
#include "motion/hold.hpp"

namespace signorini {
namespace {

constexpr double unlucky = 16.0;  // times noise and resolution, where decisions go in circles

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

using Memory = std::pair<State, double>;

/// States and memories, for recognising a cycle.
std::vector<Memory> states(const Mode& mode) {
  std::vector<Memory> result;
  for (const ContactState& c : mode) result.emplace_back(c.state, c.anchor);
  return result;
}

}  // namespace

Decider::Decider(ModeSystems& systems, int max_rounds, double capture_velocity)
    : model_(systems.model()),
      systems_(systems),
      jets_(systems),
      max_rounds_(max_rounds),
      capture_velocity_(capture_velocity),
      impacts_(systems, capture_velocity),
      groups_(coupled_contacts(systems.model())) {}

std::vector<Decider::Failure> Decider::failures(const std::vector<MotionJet>& jets, const Mode& mode,
                                                const Instant& instant, bool first,
                                                const std::vector<bool>& touching) const {
  std::vector<Failure> result;
  for (std::size_t c = 0; c < mode.size(); ++c) {
    Failure failure{c, Guard::none};
    int order = std::numeric_limits<int>::max();
    for (const GuardForm& guard : guards(model_.contacts[c], mode[c])) {
      if (guard.kind == Guard::none) continue;
      const bool fired = first && instant.has_fired(c, guard.kind);
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

bool Decider::evaluate(const Instant& instant, const Forcing& after, const Mode& mode, Decision& decision,
                       std::vector<MotionJet>& jets) {
  decision.system = systems_.of(mode);
  if (!decision.system) return false;
  decision.u = instant.u;
  decision.v = instant.v;
  hold(model_, *decision.system, after, instant.t, decision.u, decision.v);
  decision.jet = jets_.make(decision.system, after, instant.t, decision.u, decision.v, jets);
  decision.u = decision.jet.u.col(0);
  decision.v = decision.jet.u.col(1);
  decision.mode = mode;
  return true;
}

std::vector<BodySlide> Decider::slides(const Forcing& forcing, double t, const Vector& u,
                                       const Vector& v) const {
  std::vector<BodySlide> result;
  for (std::size_t k = 0; k < model_.contacts.size(); ++k)
    result.push_back(slide_of(model_.contacts[k], k, forcing, t, u, v));
  return result;
}

Decision Decider::decide(Instant instant, const Forcing& before, const Forcing& after) {
  Decision decision;
  const std::size_t count = model_.contacts.size();
  decision.visited.assign(count, false);
  decision.jumped.assign(count, false);
  decision.crossings.resize(count);
  std::vector<MotionJet> jets;
  Joint joint(count);

  // The motion just before, in the old mode under the old forcing.
  if (!evaluate(instant, before, instant.mode, decision, jets)) {
    decision.reason = dependent_rows;
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
    decision.reason = dependent_rows;
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
                      max_rounds_, names_of(model_, failed));
      return decision;
    }
    std::vector<bool> jointly(count, false);
    for (const Failure& f : failed) {
      const Contact& contact = model_.contacts[f.contact];
      if (!decision.visited[f.contact]) decision.crossings[f.contact] = crossing(f.form, jets[f.contact]);
      decision.visited[f.contact] = true;
      const bool slips = f.guard == Guard::slip_plus || f.guard == Guard::slip_minus;
      if (contact.takes_impulses() || (joint.sliders && contact.sticks_rigidly())) {
        jointly[f.contact] = true;
        // It was left at its static limit, and that falls.
        if (slips && joint.decided[f.contact]) joint.kinetic[f.contact] = true;
        if (f.guard == Guard::sliding && joint.decided[f.contact] &&
            starts_at_zero(f.form, jets[f.contact], instant))
          joint.rests[f.contact] = true;
      } else {
        mode[f.contact] = next_state(contact, mode[f.contact], f.guard, jets[f.contact]);
      }
    }
    for (const std::vector<std::size_t>& group : groups_) {
      const bool concerned =
          joint.sliders || (open && has_rigid(group)) ||
          std::any_of(group.begin(), group.end(), [&](std::size_t c) { return jointly[c]; });
      if (!concerned) continue;
      if (std::string why = decide_jointly(instant, after, joint, decision, jets, failed, group, mode);
          !why.empty()) {
        decision.reason = failed.empty() ? why : fmt::format("{} (after {})", why, names_of(model_, failed));
        return decision;
      }
    }
    std::vector<Memory> now = states(mode);
    if (!open && std::find(seen.begin(), seen.end(), now) != seen.end() && decision.impulses.empty()) {
      if (!blurred) {
        // What is zero was told by one sample of rounding, and by the clock: perhaps too sharply.
        blurred = true;
        instant.blur = unlucky;
        instant.resolution *= unlucky;
        seen.clear();
      } else if (joint.sliders) {
        decision.reason = fmt::format("no combination of states is consistent; guards that fail: {}",
                                      names_of(model_, failed));
        return decision;
      } else {
        joint.sliders = true;
      }
    }
    seen.push_back(std::move(now));
    if (!evaluate(instant, after, mode, decision, jets)) {
      const bool rigid = std::any_of(failed.begin(), failed.end(), [&](const Failure& f) {
        return model_.contacts[f.contact].takes_impulses();
      });
      decision.reason =
          fmt::format("{} (after {}); {} makes them so", dependent_rows, names_of(model_, failed),
                      rigid ? "law = \"compliant\"" : "a tangential_stiffness");
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

Decision Decider::adopt(const Instant& instant, const Mode& mode, const Forcing& forcing) {
  Decision decision;
  decision.visited.assign(mode.size(), false);
  decision.jumped.assign(mode.size(), false);
  decision.crossings.resize(mode.size());
  std::vector<MotionJet> jets;
  if (!evaluate(instant, forcing, mode, decision, jets)) {
    decision.reason = dependent_rows;
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
