// grazes.hpp: guards of an integrator that returned into their tolerance and left it without an event.
//
//   high    the greatest value since the segment's start, counted up to the level (watch.hpp)
//   low     g < high - (dip level + rounding of g)
//   graze   it was low and has reached the level without an event; or it was low before it ever reached the
//           level, and the segment ended with another guard's fall
//
// Below the level a guard's sign is that of the integration error: this run cannot decide whether the guard reached
// zero and rose again. A run with a smaller tolerance decides it, or reports the same.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "decide/decision.hpp"
#include "engine/falls/step_history.hpp"

namespace signorini {

/// Part of the level by which a guard has to sink: a tenth of a local tolerance. Chosen: guards that rise from zero
/// sink by less than a thousandth of it, 35 by up to a hundredth, 11 by more (30,581 in 300 random scenes); changing it
/// to 10 changes "a guard that sinks back before it has clearly risen".
inline constexpr double dip_of_level = 0.01;

class Grazes {
 public:
  struct Graze {
    double t = 0.0;  ///< time of its lowest value
    std::size_t slot = 0;
    Guard guard = Guard::none;
  };

  /// levels: one for each slot, as for Watch.
  void start(const std::vector<GuardStart>& guards, const std::vector<double>& levels);
  /// Examines the part [0, limit] of the last step; scalars 0.. of the history are the guards.
  void see(const StepHistory& history, double limit);
  /// The segment ends because these guards reached zero.
  void end(const std::vector<std::size_t>& fallen);
  /// First graze since the beginning of the run.
  [[nodiscard]] const std::optional<Graze>& first() const { return first_; }

 private:
  struct Guarded {
    Guard guard = Guard::none;
    double level = 0.0, dip = 0.0;
    double high = -std::numeric_limits<double>::infinity();
    double lowest = 0.0, t_lowest = 0.0;
    bool low = false;
  };
  void note(std::size_t slot);
  std::vector<Guarded> guards_;
  std::optional<Graze> first_;
};

}  // namespace signorini
