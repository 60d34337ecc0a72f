// touch_tracker.hpp: last touches of contacts, times since which guards are zero, and landings.
//
// At its last touch a contact has exactly g = 0; afterwards rounding accumulates in the gap.
//
//   last touch of k = last instant with contact k closed just before or just after it, or with an impulse; 0: none
#pragma once

#include <limits>
#include <vector>

#include "decide/decision.hpp"
#include "decide/instant.hpp"
#include "engine/stepper.hpp"

namespace signorini::run {

/// Stores the time of the last touch of each contact.
class TouchTracker {
 public:
  explicit TouchTracker(std::size_t contacts) : times_(contacts, 0.0) {}

  void instant(double t, const contact::ContactStates& before, const decide::Decision& decision) {
    for (std::size_t k = 0; k < times_.size(); ++k)
      if (!before[k].is_open() || !decision.states[k].is_open() ||
          (!decision.impulses.empty() && decision.impulses[k].normal > 0.0))
        times_[k] = t;
  }
  [[nodiscard]] const std::vector<double>& times() const { return times_; }

 private:
  std::vector<double> times_;
};

// Times since which guards are zero up to rounding.
//
//   since_k = last change of the forcing at which guard k and all its known derivatives were zero
//
// A guard that changes with a high power of time stays below its rounding error for a long time. If it was never above
// this error, its event may have happened at any time after since_k.

class ZeroTracker {
 public:
  /// Updates the times after a decision at t. changed: the forcing follows another formula from t on.
  void update(double t, const decide::Decision& decision, bool changed) {
    layout_ = decision.layout;
    since_.resize(decision.guards.size(), none);
    for (std::size_t slot = 0; slot < since_.size(); ++slot) {
      const decide::GuardStart& guard = decision.guards[slot];
      if (guard.kind == Guard::none || !guard.at_zero || guard.leading_order >= 0)
        since_[slot] = none;
      else if (changed || !(since_[slot] <= t) || kinds_[slot] != guard.kind)
        since_[slot] = t;
    }
    kinds_.resize(decision.guards.size());
    for (std::size_t slot = 0; slot < kinds_.size(); ++slot) kinds_[slot] = decision.guards[slot].kind;
  }

  /// Durations for which the guards triggered at t had been zero, one entry per contact; empty if no triggered guard had
  /// been zero before t.
  [[nodiscard]] std::vector<double> zero_durations(double t,
                                                   const std::vector<decide::TriggeredGuard>& fired) const {
    std::vector<double> result;
    if (layout_.contacts() == 0) return result;  // update() has not been called yet
    for (const decide::TriggeredGuard& f : fired)
      for (std::size_t slot = layout_.guard(f.contact); slot < layout_.guard_end(f.contact); ++slot) {
        if (!f.never_positive || kinds_[slot] != f.guard || !(since_[slot] < t)) continue;
        result.resize(layout_.contacts(), 0.0);
        result[f.contact] = t - since_[slot];
      }
    return result;
  }

 private:
  static constexpr double none = std::numeric_limits<double>::infinity();
  ForceLayout layout_;
  std::vector<double> since_;  // one entry per guard slot
  std::vector<Guard> kinds_;   // guard kind of each slot
};

// Time, impulse, peak force and duration of every closure of a contact.
//
//   impulse = sum of Pn at hits + integral of -N dt,   from the instant of closing to that of opening
//
// Impulses are never converted to forces: a hit without a closure has an impulse, but its peak force is zero.

class LandingTracker {
 public:
  explicit LandingTracker(const Model& model)
      : model_(model), ended_(model.contacts.size()), now_(model.contacts.size()) {}

  void begin(double t, const contact::ContactStates& states);
  /// Adds the integrals of -N over the time since the last call.
  void add(const motion::WorkIntegrals& works);
  void observe(std::size_t contact, double N);
  void instant(double t, const decide::Decision& decision, const contact::ContactStates& old_states);
  /// All landings, one list per contact; landings that have not ended end at t.
  [[nodiscard]] std::vector<std::vector<Landing>> finish(double t,
                                                         const contact::ContactStates& states) const;

 private:
  const Model& model_;
  std::vector<std::vector<Landing>> ended_;  // one list per contact
  std::vector<Landing> now_;                 // current landing of each contact; valid while active_[k]
  std::vector<bool> active_;
};

}  // namespace signorini::run
