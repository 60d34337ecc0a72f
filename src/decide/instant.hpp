// instant.hpp: what a decision starts from: the motion just before, and what happened.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "base/listed.hpp"
#include "contact/law.hpp"
#include "contact/mode.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// A guard that an integrator found at zero.
struct Fired {
  std::size_t contact = 0;
  Guard guard = Guard::none;
  bool unseen = false;  ///< it began at zero, and was never seen above its rounding
};

struct Instant {
  double t = 0.0;
  double resolution = 0.0;  ///< events closer than this in time are one instant
  Vector u, v;
  Mode mode;  ///< just before
  std::vector<Fired> fired;
  /// Friction limits that were zero with all their derivatives when the integrator set out, and that it has not
  /// seen fall since: zero under the forcing up to here, whatever the rounding of the way has left of them.
  std::vector<Fired> rested = {};
  /// When each contact was last at g = 0, the start where it never was; empty: not known.
  std::vector<double> touched = {};
  bool jump = false;   ///< the forcing is not smooth here
  double blur = 1.0;   ///< times the noise of a jet, below which its entries are zero
  bool start = false;  ///< of the run: what touches rigidly is decided even where nothing fails
  /// Flights lower than the rounding of their gaps are known: a series begins with g = 0 (Stepper).
  bool knows_low_flights = false;
  double slow = 0.0;  ///< slip rates up to this one are rest, whatever their rounding
  /// Flights are flown that would be taken as rest, since they are slower than capture_velocity or not known.
  bool low_flights = false;

  [[nodiscard]] bool has_fired(std::size_t contact, Guard guard) const { return has(fired, contact, guard); }
  [[nodiscard]] bool has_rested(std::size_t contact, Guard guard) const {
    return has(rested, contact, guard) && !has_fired(contact, guard);
  }

 private:
  static bool has(const std::vector<Fired>& list, std::size_t contact, Guard guard) {
    return std::any_of(list.begin(), list.end(),
                       [&](const Fired& f) { return f.contact == contact && f.guard == guard; });
  }
};

/// "'first' (compression) and 'second' (gap)": of anything with a contact and a guard.
template <class Guarded>
[[nodiscard]] std::string names_of(const Model& model, const std::vector<Guarded>& list) {
  std::vector<std::string> names;
  for (const Guarded& g : list)
    names.push_back("'" + model.contacts[g.contact].name + "' (" + to_string(g.guard) + ")");
  return listed_plainly(names);
}
template <class Guarded>
[[nodiscard]] std::vector<std::size_t> contacts_of(const std::vector<Guarded>& list) {
  std::vector<std::size_t> result;
  for (const Guarded& g : list) result.push_back(g.contact);
  return result;
}

}  // namespace signorini
