// watch.hpp: guards between restarts: the armed guards, and the one that reaches zero first.
//
//   armed      g > 0 was clearly observed: its first downward zero crossing is an event
//   not armed  g started at zero and rises; armed once g >= level, an event once g <= -level
//   level      re_arm_tolerances times the local error tolerance of g
//
// IDA reports only changes of sign between the ends of a step. On a step the solution is a polynomial of degree q <= 5,
// so is every guard, and its Bernstein coefficients prove that it stays positive or show where it does not: two
// crossings inside one step are not missed.
#pragma once

#include "engine/falls/arming.hpp"
#include "engine/falls/step_history.hpp"

namespace signorini {

/// A guard that starts at zero is armed again once it exceeds this many local error tolerances: below, its sign is that
/// of the integration error.
inline constexpr double re_arm_tolerances = 10.0;

/// Place inside the last step at which a guard reaches zero.
struct Fall {
  std::size_t slot = 0;  ///< contact/slots.hpp
  double x = 0.0;        ///< 0..1 on the step
};

class Watch {
 public:
  /// levels: re-arming levels, one for each slot.
  void start(const std::vector<GuardStart>& guards, GuardForms forms, std::vector<double> levels);
  [[nodiscard]] bool armed(std::size_t slot) const { return arming_.armed(slot); }
  /// The guard reached zero without an event: it waits again, and is an event only once it is below -`level`.
  void wait(std::size_t slot, double level);
  /// Depth below zero that this guard of the contact may reach before it is an event: 0 once it is armed.
  [[nodiscard]] double leeway(std::size_t contact, const GuardForm& guard) const;
  /// All downward zero crossings in the part [0, limit] of the last step; scalars 0.. of the history are the guards.
  /// Arms guards that have risen enough.
  [[nodiscard]] std::vector<Fall> check(const StepHistory& history, double limit);

 private:
  Arming arming_;
  GuardForms forms_;
  std::vector<double> levels_;
};

}  // namespace signorini
