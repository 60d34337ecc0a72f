// active_guards.hpp: the guards that are active in a segment.
//
//   idle      the contact state does not use this slot
//   armed     the guard was clearly positive: its next zero crossing is an event
//   waiting   the guard starts at zero, up to rounding: an event occurs only if it becomes clearly negative. If
//             leading_order > 0, the guard rises like x^leading_order: its lower derivatives are zero
//
// A waiting guard becomes armed once it exceeds a level. For engine `exact` this level is the rounding of the
// guard, for an integrator the possible error of its steps.
#pragma once

#include "decide/decision.hpp"
#include "engine/events/step_history.hpp"

namespace signorini::events {

class ActiveGuards {
 public:
  /// guards: one entry for each slot (signorini/force_layout.hpp).
  void start(const std::vector<decide::GuardStart>& guards);

  [[nodiscard]] std::size_t size() const { return guards_.size(); }
  [[nodiscard]] bool idle(std::size_t slot) const { return guards_[slot].status == Status::idle; }
  [[nodiscard]] bool armed(std::size_t slot) const { return guards_[slot].status == Status::armed; }
  /// Exponent m > 0 if the guard is x^m times a polynomial that is positive at x = 0. 0 if the guard is armed, or if its
  /// derivatives are unknown.
  [[nodiscard]] std::size_t leading_order(std::size_t slot) const { return guards_[slot].leading_order; }

  /// Sets the leading order to 0, because the guard does not rise as its derivatives at the start predict.
  void discard_leading_order(std::size_t slot) { guards_[slot].leading_order = 0; }
  /// Makes the guard wait: it is zero again, and its derivatives are unknown.
  void set_waiting(std::size_t slot) { guards_[slot] = {Status::waiting, 0}; }
  void set_armed(std::size_t slot) { guards_[slot] = {Status::armed, 0}; }
  /// Called with the guard's value at the end of a step without an event. Arms a waiting guard whose value is above the level;
  /// otherwise only discards its leading order.
  void update(std::size_t slot, double value, double level);

 private:
  enum class Status : unsigned char { idle, armed, waiting };
  struct GuardEntry {
    Status status = Status::idle;
    std::size_t leading_order = 0;
  };
  std::vector<GuardEntry> guards_;
};

// Zero crossings of the guards inside the steps of IDA.
//
//   armed      g was clearly positive: its first downward zero crossing is an event
//   not armed  g started at zero and rises; armed once g >= level, an event once g <= -level
//   level      re_arm_tolerances times the local error tolerance of g
//
// IDA reports only changes of sign between the ends of a step. On a step the solution is a polynomial of
// degree q <= 5, and so is every guard. The Bernstein coefficients of a guard prove that it stays positive, or lead to its
// zeros, so two crossings inside one step are not missed.

/// A waiting guard is armed once it exceeds this many local error tolerances. Below this level, the integration error may
/// decide the sign of the guard.
inline constexpr double re_arm_tolerances = 10.0;

/// Place inside the last step at which a guard reaches zero.
struct ZeroCrossing {
  std::size_t slot = 0;  ///< slot of the guard (signorini/force_layout.hpp)
  double x = 0.0;        ///< place in the step, 0 to 1
};

class GuardMonitor {
 public:
  /// levels: level of each slot at which a waiting guard is armed.
  void start(const std::vector<decide::GuardStart>& guards, decide::GuardForms forms,
             std::vector<double> levels, const ForceLayout& layout);
  [[nodiscard]] bool armed(std::size_t slot) const { return active_guards_.armed(slot); }
  /// Called if the guard reached zero without an event. The guard waits again; the next event occurs only if it falls below
  /// -level.
  void set_waiting(std::size_t slot, double level);
  /// Largest negative value (as a magnitude) that this guard may reach without an event. 0 if the guard is armed.
  [[nodiscard]] double allowed_depth(std::size_t contact, const GuardForm& guard) const;
  /// Finds all downward zero crossings in the part [0, limit] of the last step, and arms guards that have risen enough. The
  /// first scalars of the history are the guards, in the order of slots.
  [[nodiscard]] std::vector<ZeroCrossing> check(const StepHistory& history, double limit);

 private:
  ActiveGuards active_guards_;
  decide::GuardForms forms_;
  ForceLayout layout_;
  std::vector<double> levels_;
};

}  // namespace signorini::events
