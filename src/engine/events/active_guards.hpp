// active_guards.hpp: the guards that are active in a segment.
//
//   idle      the contact state has no guard in this slot
//   armed     the guard was clearly positive: its next zero crossing is an event
//   waiting   the guard starts at zero, up to rounding: an event occurs only if the guard becomes clearly negative. If
//             leading_order > 0, the guard rises like x^leading_order: its lower derivatives are zero
//
// A waiting guard becomes armed once its value exceeds a level. For engine `exact` this level is the rounding error of the
// guard, for an integrator the possible error of the steps.
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
  /// Sets the guard to `waiting`, because its value is zero again; its derivatives are unknown.
  void set_waiting(std::size_t slot) { guards_[slot] = {Status::waiting, 0}; }
  void set_armed(std::size_t slot) { guards_[slot] = {Status::armed, 0}; }
  /// Call it after a step without an event, with the guard's value at the end of the step. Arms a waiting guard if its value
  /// exceeds `level`; otherwise only discards its leading order.
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
//   waiting    g started at zero: g >= level arms the guard, g <= -level is an event
//   level      re_arm_tolerances times the local error tolerance of g
//
// IDA reports only changes of sign between the ends of a step. On a step the solution is a polynomial of
// degree q <= 5, and so is every guard. The Bernstein coefficients of a guard prove that it stays positive, or lead to its
// zeros, so two crossings inside one step are not missed.

/// Level that arms a waiting guard, in local error tolerances of the guard. Below this level, the sign of the guard may be
/// that of the integration error.
inline constexpr double re_arm_tolerances = 10.0;

/// Place inside the last step at which a guard reaches zero.
struct ZeroCrossing {
  std::size_t slot = 0;  ///< slot of the guard (signorini/force_layout.hpp)
  double x = 0.0;        ///< place in the step, 0 to 1
};

class GuardMonitor {
 public:
  /// levels: for each slot, the level that arms a waiting guard.
  void start(const std::vector<decide::GuardStart>& guards, decide::GuardForms forms,
             std::vector<double> levels, const ForceLayout& layout);
  [[nodiscard]] bool armed(std::size_t slot) const { return active_guards_.armed(slot); }
  /// Sets a guard that reached zero without an event to `waiting`: an event now requires a value below -level.
  void set_waiting(std::size_t slot, double level);
  /// Magnitude of the most negative value that this guard may reach without an event. 0 if the guard is armed.
  [[nodiscard]] double allowed_depth(std::size_t contact, const GuardForm& guard) const;
  /// Finds the first event of each guard in the part [0, limit] of the last step, and arms waiting guards that exceed their
  /// level. The first scalars of the history must be the guards, in the order of slots.
  [[nodiscard]] std::vector<ZeroCrossing> check(const StepHistory& history, double limit);

 private:
  ActiveGuards active_guards_;
  decide::GuardForms forms_;
  ForceLayout layout_;
  std::vector<double> levels_;
};

}  // namespace signorini::events
