// arming.hpp: which guards count between two restarts.
//
//   idle      none: the state has no such guard
//   armed     clearly positive was seen: its next fall through zero is an event
//   waiting   starts at zero, or within its rounding; an event only once it has clearly sunk below. Where
//             leading > 0 it rises like x^leading: its lower derivatives are zero
//
// A waiting guard is armed once it exceeds a level: for the exact flow the rounding of the
// guard, for an integrator what its steps may be off.
#pragma once

#include "decide/decision.hpp"

namespace signorini {

class Arming {
 public:
  /// One entry a slot (contact/slots.hpp).
  void start(const std::vector<GuardStart>& guards);

  [[nodiscard]] std::size_t size() const { return guards_.size(); }
  [[nodiscard]] bool idle(std::size_t slot) const { return guards_[slot].standing == Standing::idle; }
  [[nodiscard]] bool armed(std::size_t slot) const { return guards_[slot].standing == Standing::armed; }
  /// The guard is x^leading times a polynomial that is positive at 0; 0: it is armed, or nothing is known.
  [[nodiscard]] std::size_t leading(std::size_t slot) const { return guards_[slot].leading; }

  /// What its derivatives at the start said has been refuted.
  void doubt(std::size_t slot) { guards_[slot].leading = 0; }
  /// It is zero again, and nothing is known of it.
  void wait(std::size_t slot) { guards_[slot] = {Standing::waiting, 0}; }
  void arm(std::size_t slot) { guards_[slot] = {Standing::armed, 0}; }
  /// Its value at the end of a step without an event: what started at zero is armed above the level, and
  /// its derivatives at the start say no more.
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
