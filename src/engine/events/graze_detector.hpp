// graze_detector.hpp: guards of an integrator that returned into their tolerance and left it without an event.
//
//   high    the greatest value since the segment's start, at most the level (active_guards.hpp)
//   low     g < high - (dip_fraction level + rounding of g)
//   graze   the guard was low and has reached the level without an event; or it was low before it ever
//           reached the level, and the segment ended with a zero crossing of another guard
//
// Below the level a guard's sign is that of the integration error: this run cannot decide whether the guard reached
// zero and rose again. A run with a smaller tolerance decides it, or reports the same.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "decide/decision.hpp"
#include "engine/events/graze.hpp"
#include "engine/events/step_history.hpp"

namespace signorini::events {

/// Part of the level by which a guard must sink to be low: a tenth of a local tolerance. Chosen: of 30,581
/// guards that rise from zero in 300 random scenes, 35 sink by a thousandth to a hundredth of the level, 11
/// by more, all others by less. A value of 10 changes the test "a guard that sinks back before it has clearly
/// risen".
inline constexpr double dip_fraction = 0.01;

class GrazeDetector {
 public:
  struct Graze {
    double t = 0.0;  ///< time of its lowest value
    std::size_t slot = 0;
    Guard guard = Guard::none;
  };

  /// levels: one for each slot, as for GuardMonitor.
  void start(const std::vector<decide::GuardStart>& guards, const std::vector<double>& levels);
  /// Examines the part [0, limit] of the last step; scalars 0.. of the history are the guards.
  void update(const StepHistory& history, double limit);
  /// Called at the end of a segment. fallen: slots of the guards that reached zero.
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
//   g_a > g_b <= g_c  at three consecutive samples:  a minimum of the gap at the parabola's vertex
//   g > level         at a sample since the last minimum: a gap that closes and stays closed is no near hit
//
// Near hits are recorded if the gap is less than 1e4 levels (active_guards.hpp), a possible sum of the errors
// of thousands of steps. Only the error of the run decides whether an impact was missed there, and the run
// does not know its error (certify/error_bounds.hpp).

class NearHitDetector {
 public:
  /// levels: one for each slot, as for Watch.
  void start(const std::vector<decide::GuardStart>& guards, const std::vector<double>& levels,
             const ForceLayout& layout);
  /// Examines the part [0, limit] of the last step; scalars 0.. of the history are the guards.
  void update(const StepHistory& history, double limit);
  /// Near hits of the run so far, in the order of time except for those of the same step.
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
    int sample_count = 0;  // number of last samples that are kept
    GapSample before, last;
  };
  void update_gap(GapHistory& gap, const GapSample& now);

  std::vector<GapHistory> gaps_;
  std::vector<NearHit> list_;
};

}  // namespace signorini::events
