// graze_detector.hpp: guards of an integrator that approached zero to within the integration error and rose again.
//
//   high    greatest value of the guard since the segment's start, but at most the level (active_guards.hpp)
//   low     g < high - (dip_fraction level + rounding of g)
//   graze   the guard was low and then rose to the level without an event; or the guard was low before it ever
//           reached the level, and the segment ended with a zero crossing of another guard
//
// Below the level, the integration error can change the sign of the guard, so this run cannot decide whether the guard reached
// zero and rose again. A run with a smaller tolerance decides, or reports a graze again.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "decide/decision.hpp"
#include "engine/events/graze.hpp"
#include "engine/events/step_history.hpp"

namespace signorini::events {

/// Part of the level by which a guard must decrease below `high` to be low: 0.01, a tenth of a local tolerance. Measured on
/// 30,581 guards that rise from zero in 300 random scenes: 35 decrease by 0.001 to 0.01 of the level, 11 by more, all others by
/// less. With a value of 10, the test "a guard that sinks back before it has clearly risen" fails.
inline constexpr double dip_fraction = 0.01;

class GrazeDetector {
 public:
  struct Graze {
    double t = 0.0;  ///< time of the guard's lowest value
    std::size_t slot = 0;
    Guard guard = Guard::none;
  };

  /// levels: re-arming level of each slot (active_guards.hpp).
  void start(const std::vector<decide::GuardStart>& guards, const std::vector<double>& levels);
  /// Examines the part [0, limit] of the last step. The first scalars of the history are the guards, in the order of slots.
  void update(const StepHistory& history, double limit);
  /// Call it at the end of a segment. fallen: slots of the guards whose zero crossing ends the segment.
  void end(const std::vector<std::size_t>& fallen);
  /// First graze since the beginning of the run.
  [[nodiscard]] const std::optional<Graze>& first() const { return first_; }

 private:
  struct GuardHistory {
    Guard guard = Guard::none;
    double level = 0.0, dip = 0.0;
    double high = -std::numeric_limits<double>::infinity();
    double lowest = 0.0, t_lowest = 0.0;
    bool low = false;
  };
  void record(std::size_t slot);
  std::vector<GuardHistory> guards_;
  std::optional<Graze> first_;
};

// Gaps of an integrator that approached zero and opened again.
//
//   g_a > g_b <= g_c  at three consecutive samples:  a minimum of the gap at the vertex of the parabola
//   g > level         at a sample since the last minimum, so that the oscillations of a closed gap are no near hits
//
// A minimum is recorded as a near hit if its gap is less than 1e4 levels (active_guards.hpp): the errors of thousands of steps
// can sum up to this size. Only a certified run bounds the error of the whole run and shows whether an impact was missed
// (certify/error_bounds.hpp).

class NearHitDetector {
 public:
  /// levels: re-arming level of each slot (active_guards.hpp).
  void start(const std::vector<decide::GuardStart>& guards, const std::vector<double>& levels,
             const ForceLayout& layout);
  /// Examines the part [0, limit] of the last step. The first scalars of the history are the guards, in the order of slots.
  void update(const StepHistory& history, double limit);
  /// Near hits of the run so far, in ascending order of steps; unordered within a step.
  [[nodiscard]] const std::vector<NearHit>& list() const { return list_; }

 private:
  struct GapSample {
    double t = 0.0, gap = 0.0;
  };
  struct GapHistory {
    std::size_t slot = 0;
    int contact = -1;
    double level = 0.0;
    double high = 0.0;     // greatest gap since the last minimum
    int sample_count = 0;  // number of successive samples so far; a minimum needs three
    GapSample before, last;
  };
  void update_gap(GapHistory& gap, const GapSample& now);

  std::vector<GapHistory> gaps_;
  std::vector<NearHit> list_;
};

}  // namespace signorini::events
