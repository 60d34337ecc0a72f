// arming.hpp: the guards that are active between two restarts.
//
//   idle      not active: the state has no such guard
//   armed     was clearly positive; its next zero crossing is an event
//   waiting   starts at zero, or within its rounding; an event only once it is clearly negative. If
//             leading > 0 it rises like x^leading: its lower derivatives are zero
//
// A waiting guard becomes armed once it exceeds a level: the rounding of the guard for the exact flow, the possible
// error of the steps for an integrator.
#pragma once

#include "decide/decision.hpp"

namespace signorini {

class Arming {
 public:
  /// One entry for each slot (contact/slots.hpp).
  void start(const std::vector<GuardStart>& guards);

  [[nodiscard]] std::size_t size() const { return guards_.size(); }
  [[nodiscard]] bool idle(std::size_t slot) const { return guards_[slot].standing == Standing::idle; }
  [[nodiscard]] bool armed(std::size_t slot) const { return guards_[slot].standing == Standing::armed; }
  /// The guard is x^leading times a polynomial that is positive at 0; 0: the guard is armed, or its derivatives are
  /// unknown.
  [[nodiscard]] std::size_t leading(std::size_t slot) const { return guards_[slot].leading; }

  /// The prediction by the guard's derivatives at the start has been refuted.
  void doubt(std::size_t slot) { guards_[slot].leading = 0; }
  /// The guard is zero again, and its derivatives are unknown.
  void wait(std::size_t slot) { guards_[slot] = {Standing::waiting, 0}; }
  void arm(std::size_t slot) { guards_[slot] = {Standing::armed, 0}; }
  /// Takes the guard's value at the end of a step without an event: a guard that started at zero is armed above the
  /// level, and its derivatives at the start are no longer used.
  void see(std::size_t slot, double value, double level);

 private:
  enum class Standing : unsigned char { idle, armed, waiting };
  struct Guarded {
    Standing standing = Standing::idle;
    std::size_t leading = 0;
  };
  std::vector<Guarded> guards_;
};

}  // namespace signorini
