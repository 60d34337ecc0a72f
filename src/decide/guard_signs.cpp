#include "decide/guard_signs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace signorini::decide {
namespace {

/// Derivative of order k, and noise of this derivative, for any guard and for the QuickForm of a linear guard.
double derivative(const GuardForm& guard, const MotionJet& jet, std::size_t k) {
  return guard.derivative(jet.motion.data(), k);
}
double derivative(const QuickForm& form, const MotionJet& jet, std::size_t k) {
  return k == 0 ? form.value(jet.motion[0]) : form.rate(jet.motion[k]);
}
double noise_of(const GuardForm& guard, const MotionJet& jet, std::size_t k) {
  return guard.rounding(jet.motion.data(), jet.noise.data(), k);
}
double noise_of(const QuickForm& form, const MotionJet& jet, std::size_t k) {
  return form.magnitude(jet.noise[k]);
}

/// Magnitude up to which the derivative of order k is treated as zero. blur: factor on the noise.
template <class F>
double zero_of(const F& guard, const MotionJet& jet, double blur, double resolution, std::size_t k) {
  double zero = blur * noise_of(guard, jet, k) + std::numeric_limits<double>::min();
  if (k + 1 < jet.motion.size()) zero += resolution * std::abs(derivative(guard, jet, k + 1));
  return zero;
}
double zero_of(const GuardForm& guard, const MotionJet& jet, const Instant& instant, std::size_t k) {
  return zero_of(guard, jet, instant.noise_factor, instant.resolution, k);
}

/// True if derivatives of the guard of orders `first` to `orders` - 1 determine its sign. blur: factor on the noise.
template <class F>
bool sign_is_decided(const F& guard, const MotionJet& jet, std::size_t first, std::size_t orders,
                     bool triggered, double blur, double resolution) {
  for (std::size_t k = first; k < orders; ++k) {
    const double d = derivative(guard, jet, k);
    if (!(std::abs(d) > zero_of(guard, jet, blur, resolution, k)) || (triggered && k == 1 && d > 0.0))
      continue;
    // If a guard is negative in value, all derivatives are needed, because next_state() and crossing() use them.
    return !(d < 0.0 && orders == 1);
  }
  return false;
}

/// The guard of a contact that fails first; nullopt: no guard fails.
std::optional<FailedGuard> failure_of(const Contact& contact, std::size_t c, const MotionJet& jet,
                                      const ContactState& state, const Instant& instant, bool before,
                                      const KnownGuards& known, const MotionJet* motion_up_to_instant) {
  const auto all = contact::guards(contact, state);
  std::optional<FailedGuard> soonest;
  for (const GuardForm& guard : all) {
    if (guard.kind == Guard::none) continue;
    // A guard located by the engine is zero even if rounding makes its value positive. Since the guard was decreasing, a
    // positive rate is treated as zero: it is an error of the integration.
    const bool triggered = before && instant.has_triggered(c, guard.kind);
    Known guard_known = known.of(guard.kind);
    if (triggered && guard.value(jet.motion[0]) > 0.0)
      guard_known.zeros = std::max<std::size_t>(1, guard_known.zeros);
    const MotionJet* base = motion_up_to_instant
                                ? resting_reference(contact, c, state, guard, *motion_up_to_instant, instant)
                                : nullptr;
    Sign sign = sign_of_guard(guard, jet, instant, guard_known, base);
    if (triggered && !instant.jump && sign.sign > 0 && sign.order == 1) {
      guard_known.zeros = std::max<std::size_t>(2, guard_known.zeros);
      sign = sign_of_guard(guard, jet, instant, guard_known);
    }
    // The guard with the lowest failing order decides: a friction limit that is exceeded now comes before a compression that
    // ends later. If orders are equal, separation (the first guard) decides, because with N = 0 the friction limit is zero,
    // too.
    if (sign.sign >= 0 || (soonest && sign.order >= soonest->sign.order)) continue;
    soonest = FailedGuard{c, guard.kind, guard, sign};
  }
  if (!soonest || soonest->sign.order == 0) return soonest;
  // If a contact opens without slip, friction limit and compression become zero together: this is one event, a separation.
  if (contact::is_friction_limit(soonest->guard)) {
    const GuardForm& separation = all[0];
    if (separation.kind == Guard::separation && starts_at_zero(separation, jet, instant) &&
        derivative(separation, jet, 1) < 0.0) {
      soonest->guard = Guard::separation;
      soonest->form = separation;
    }
  }
  return soonest;
}

}  // namespace

const MotionJet* resting_reference(const Contact& contact, std::size_t c, const ContactState& state,
                                   const GuardForm& guard, const MotionJet& motion_up_to_instant,
                                   const Instant& instant) {
  const auto rests = [&](const GuardForm& limit) {
    const bool is_zero =
        limit.value(motion_up_to_instant.motion[0]) <= zero_of(limit, motion_up_to_instant, instant, 0);
    return is_zero && instant.is_resting_limit(c, limit.kind);
  };
  bool any = rests(guard);
  if (guard.kind == Guard::sliding && contact.anchor_spring())
    for (const GuardForm& limit : contact::guards(contact, ContactState{State::stick, state.anchor}))
      any = any || ((limit.kind == Guard::friction_limit ||
                     limit.kind == (slip_sign(state.state) > 0 ? Guard::slip_plus : Guard::slip_minus)) &&
                    rests(limit));
  return any ? &motion_up_to_instant : nullptr;
}

Sign leading_sign(const GuardForm& form, const MotionJet& jet, const Instant& instant, std::size_t first,
                  const MotionJet* base) {
  for (std::size_t k = first; k < jet.motion.size(); ++k) {
    const double d = derivative(form, jet, k) - (base ? derivative(form, *base, k) : 0.0);
    const double zero = zero_of(form, jet, instant, k);
    if (std::abs(d) > zero) return {d > 0.0 ? 1 : -1, static_cast<int>(k), std::abs(d) / zero};
  }
  return {0, static_cast<int>(jet.motion.size()), 0.0};
}

Sign sign_of_guard(const GuardForm& form, const MotionJet& jet, const Instant& instant, const Known& known,
                   const MotionJet* base) {
  const Sign sign = leading_sign(form, jet, instant, known.zeros, base);
  if (!known.rises || (sign.sign < 0 && sign.order == static_cast<int>(known.zeros))) return sign;
  return {1, static_cast<int>(known.zeros), sign.order == static_cast<int>(known.zeros) ? sign.excess : 1.0};
}

bool starts_at_zero(const GuardForm& form, const MotionJet& jet, const Instant& instant) {
  const double zero =
      instant.noise_factor * noise_of(form, jet, 0) + instant.resolution * std::abs(derivative(form, jet, 1));
  return std::abs(form.value(jet.motion[0])) <= zero;
}

const GuardsOfState& GuardCache::of(std::size_t c, const ContactState& state) {
  if (states_[c] != state) {
    states_[c] = state;
    forms_.set(c, contact::guards(model_.contacts[c], state));
  }
  return forms_[c];
}

bool signs_are_decided(const GuardsOfState& guards, std::size_t c, const MotionJet& jet, std::size_t orders,
                       const Instant& instant, const KnownGuards& known, double max_noise_factor) {
  if (orders == MotionJet::orders) return true;
  // The sign of a resting limit depends on the motion up to the instant (resting_reference()), which is not available here.
  if (instant.is_resting_limit(c, Guard::slip_plus) || instant.is_resting_limit(c, Guard::slip_minus))
    return false;
  const double blur = max_noise_factor * instant.noise_factor,
               resolution = max_noise_factor * instant.resolution;
  for (const GuardForm& guard : guards) {
    if (guard.kind == Guard::none) continue;
    // A guard located by the engine is zero, and its positive rate is treated as zero, as in failure_of().
    const bool triggered = instant.has_triggered(c, guard.kind);
    const std::size_t first = std::max<std::size_t>(triggered ? 1 : 0, known.of(guard.kind).zeros);
    if (!(guard.is_linear()
              ? sign_is_decided(QuickForm(guard.form), jet, first, orders, triggered, blur, resolution)
              : sign_is_decided(guard, jet, first, orders, triggered, blur, resolution)))
      return false;
  }
  return true;
}

double relative_violation(const GuardForm& form, const MotionJet& jet, const Instant& instant,
                          std::size_t first) {
  double most = 0.0;
  for (std::size_t k = first; k < jet.motion.size(); ++k) {
    const double ratio = derivative(form, jet, k) / zero_of(form, jet, instant, k);
    if (ratio > 1.0) break;
    if (ratio < -1.0) most = std::max(most, -ratio);
  }
  return most;
}

std::vector<FailedGuard> find_failed_guards(const Model& model, const std::vector<MotionJet>& jets,
                                            const contact::ContactStates& states, const Instant& instant,
                                            bool before, const std::vector<KnownGuards>& known,
                                            const std::vector<MotionJet>& motion_up_to_instant,
                                            const std::vector<std::size_t>& asked) {
  std::vector<FailedGuard> result;
  for (const std::size_t c : asked)
    if (auto failed = failure_of(model.contacts[c], c, jets[c], states[c], instant, before, known[c],
                                 motion_up_to_instant.empty() ? nullptr : &motion_up_to_instant[c]))
      result.push_back(std::move(*failed));
  return result;
}

}  // namespace signorini::decide
