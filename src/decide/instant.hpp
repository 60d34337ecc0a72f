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
};

struct Instant {
  double t = 0.0;
  double resolution = 0.0;  ///< events closer than this in time are one instant
  Vector u, v;
  Mode mode;  ///< just before
  std::vector<Fired> fired;
  /// When each contact was last at g = 0, the start where it never was; empty: not known.
  std::vector<double> touched = {};
  bool jump = false;   ///< the forcing is not smooth here
  double blur = 1.0;   ///< times the noise of a jet, below which its entries are zero
  bool start = false;  ///< of the run: what touches rigidly is decided even where nothing fails
  /// A flight lower than the rounding of its gap is flown, not taken as rest: a series knows it all the same.
  bool low_flights = false;

  [[nodiscard]] bool has_fired(std::size_t contact, Guard guard) const {
    return std::any_of(fired.begin(), fired.end(),
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

}  // namespace signorini
