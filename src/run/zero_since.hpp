// zero_since.hpp: times since when guards are zero up to rounding.
//
//   since_k = last change of the forcing's formula at which guard k and all its known derivatives were zero
//
// A guard that changes with a high power of time stays below its rounding for a long time: if a guard was never
// observed above it, its event may have happened at any time since then.
#pragma once

#include <limits>
#include <vector>

#include "decide/decision.hpp"
#include "decide/instant.hpp"

namespace signorini {

class ZeroSince {
 public:
  /// Updates the times after a decision at t. changed: the forcing has another formula from here on.
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

  /// Time for which the guards triggered at t had been zero, one entry per contact; empty: none had.
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
  std::vector<double> since_;  // one entry per guard slot
  std::vector<Guard> kinds_;   // guard kind of each slot
};

}  // namespace signorini
