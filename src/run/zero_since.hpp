// zero_since.hpp: since when guards are zero to their rounding.
//
//   since_k = when the forcing last changed its formula while guard k and all derivatives that are known were zero
//
// A guard that rises or falls with a high power of time is below its rounding for long: an event whose guard was
// never seen above it may have happened at any time since then.
#pragma once

#include <limits>
#include <vector>

#include "decide/decision.hpp"
#include "decide/instant.hpp"

namespace signorini {

class ZeroSince {
 public:
  /// What goes on from t. changed: the forcing is another one from here on.
  void decided(double t, const Decision& decision, bool changed) {
    since_.resize(decision.guards.size(), none);
    for (std::size_t slot = 0; slot < since_.size(); ++slot) {
      const GuardStart& guard = decision.guards[slot];
      if (guard.kind == Guard::none || !guard.at_zero || guard.leading >= 0)
        since_[slot] = none;
      else if (changed || !(since_[slot] <= t) || kinds_[slot] != guard.kind)
        since_[slot] = t;
    }
    kinds_.resize(decision.guards.size());
    for (std::size_t slot = 0; slot < kinds_.size(); ++slot) kinds_[slot] = decision.guards[slot].kind;
  }

  /// For how long the guards that fell at t had been zero, one a contact; empty: none had.
  [[nodiscard]] std::vector<double> before(double t, const std::vector<Fired>& fired) const {
    std::vector<double> result;
    for (const Fired& f : fired)
      for (std::size_t slot = guards_per_contact * f.contact; slot < guards_per_contact * (f.contact + 1);
           ++slot) {
        if (!f.unseen || slot >= since_.size() || kinds_[slot] != f.guard || !(since_[slot] < t)) continue;
        result.resize(since_.size() / guards_per_contact, 0.0);
        result[f.contact] = t - since_[slot];
      }
    return result;
  }

 private:
  static constexpr double none = std::numeric_limits<double>::infinity();
  std::vector<double> since_;  // one a slot
  std::vector<Guard> kinds_;   // that it is of
};

}  // namespace signorini
