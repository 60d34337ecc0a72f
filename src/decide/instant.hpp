// instant.hpp: input of a decision: the motion just before an instant, and the guards that the engine located at zero.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "contact/contact_states.hpp"
#include "contact/law.hpp"
#include "signorini/model.hpp"

namespace signorini::decide {

/// A guard that the engine located at zero.
struct TriggeredGuard {
  std::size_t contact = 0;
  Guard guard = Guard::none;
  /// True: the guard was zero at the beginning of the segment and never exceeded its rounding error.
  bool never_positive = false;
};

/// The motion just before an event, just before a jump of the forcing, or at the start.
struct Instant {
  double t = 0.0;
  double resolution = 0.0;  ///< events closer than this time are treated as one instant
  Vector u, v;
  contact::ContactStates states;  ///< contact states just before the instant
  std::vector<TriggeredGuard> triggered;
  /// Friction limits that were zero with all their derivatives at the beginning of the segment, and have not failed since then.
  /// They are zero up to this instant, although their computed values contain accumulated rounding errors.
  std::vector<TriggeredGuard> resting_limits = {};
  /// For each contact, the last time at which g was zero; the start of the run if there was no such time. Empty: unknown.
  std::vector<double> last_touch = {};
  bool jump = false;          ///< true: the forcing is not smooth at this instant
  double noise_factor = 1.0;  ///< an entry of a jet is zero if it is below this factor times its noise
  /// True: start of the run; touching rigid contacts are then decided although no guard fails.
  bool start = false;
  /// Value of Stepper::resolves_low_flights of the engine.
  bool resolves_low_flights = false;
  /// Slip rates up to this value plus their rounding error are treated as zero; length/time.
  double rest_speed = 0.0;
  /// True: flights are computed even if their height or speed is so small that they would otherwise be replaced by rest.
  bool keep_low_flights = false;

  [[nodiscard]] bool has_triggered(std::size_t contact, Guard guard) const {
    return has(triggered, contact, guard);
  }
  [[nodiscard]] bool is_resting_limit(std::size_t contact, Guard guard) const {
    return has(resting_limits, contact, guard) && !has_triggered(contact, guard);
  }

 private:
  static bool has(const std::vector<TriggeredGuard>& list, std::size_t contact, Guard guard) {
    return std::any_of(list.begin(), list.end(),
                       [&](const TriggeredGuard& f) { return f.contact == contact && f.guard == guard; });
  }
};

/// Names of contacts and guards as text: "'first' (compression) and 'second' (gap)". Guarded: a type with members `contact` and
/// `guard`.
template <class Guarded>
[[nodiscard]] std::string names_of(const Model& model, const std::vector<Guarded>& list) {
  std::vector<std::string> names;
  for (const Guarded& g : list)
    names.push_back("'" + model.contacts[g.contact].name + "' (" + contact::to_string(g.guard) + ")");
  return base::join_texts(names);
}
template <class Guarded>
[[nodiscard]] std::vector<std::size_t> contacts_of(const std::vector<Guarded>& list) {
  std::vector<std::size_t> result;
  for (const Guarded& g : list) result.push_back(g.contact);
  return result;
}

}  // namespace signorini::decide
