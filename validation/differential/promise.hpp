// promise.hpp: what an engine may be off, and whether it was.
//
//   |other - reference|(t)  <=  spread(t) + delta       u, v, forces, relative
//   |t_other - t_reference| <=  spread + blur (t_uncertainty of both) + least_time       events
//   a split of the sequences only where members of the spread split, or did before, or where events are
//   closer to each other than `resolution` of their own t_uncertainty
//
// `spread` is the deviation of solutions that differ by as much error as the engine may have made.
#pragma once

#include "differential/deviation.hpp"

namespace signorini::differential {

struct Promise {
  Deviation spread;
  double factor = 1.0;  ///< of the spread
  double delta = 0.0;   ///< accumulated local error, relative
  double blur = 1.0;    ///< how many local errors an event's guard may be off
  double resolution = 0.0;
  double least_time = 0.0;  ///< by which events may always be off
};

struct Finding {
  bool kept = true;
  bool unresolved = false;  ///< the sequences part, and only the events' own uncertainty explains it
  double worst = 0.0;       ///< greatest deviation in units of what is allowed, before any split
  /// Events compared, and those among them that are within spread + 3 t_uncertainty of both + least_time.
  std::size_t times = 0, sharp_times = 0;
  double until = 0.0;   ///< to where both the run and members of the spread were compared
  bool to_end = false;  ///< which is the end of the run
  std::string what;     ///< the worst, or the split that nothing explains
};

[[nodiscard]] Finding check(const Deviation& deviation, const Promise& promise);

}  // namespace signorini::differential
