// companion.hpp: what a run is certified by, and whether that is worth it.
//
//   run       companion  how                              c    why
//   not exact exact      as it is                         1.5  the difference is the error
//   ida       finer      rtol / 100, atol / 100           2    at rtol / 10 errors may be alike
//   of a dt   ida        rtol 1e-9 at most                1.5  the difference is the error
//   of a dt   finer      dt / 2                           3    4/3 at order two, 2 at order one
//   exact     finer      twice, data off by one rounding  5    two draws of a random error
//
// Beside exact the difference contains ida's own local error: a tenth of t_uncertainty is added, for what
// guards that graze hide of it; half of it at rtol / 100, since in chatter the companion errs alike. Else all
// of it, since the companion's own error is as large.
//
// In series a run makes the same roundings in each step of the same length (exact_engine.cpp, share_of_step): after N steps
// they are N times one rounding, and data off by a rounding show nothing of it, since they turn a motion and neither damp it
// nor feed it. So companions of `exact` take steps of other lengths, by chance.
//
// In modes an event's time is known to the rounding of a sum over modes only, tau: a bound that two draws seldom come
// near. What follows begins at that time, so companions of `exact` move each such event by tau / c, along the motion. Its own
// row has the time without that; what the motion makes of it later is in D, and c D bounds what it makes of tau.
//
// What a step does not resolve, half of it does not resolve either: stiff dashpots ring at both, and contacts with them. So
// dt / 2 is taken where it is asked for only, and then certifies nothing unless dt max(omega_max, fastest decay) <= 1.
//
// What is decided by a tolerance is decided by the run's in all of them: velocities below which
// rebounds rest, and heights below which ida leaves flights to the series. A finer run that integrated
// flights which its run takes exactly would be the worse of the two: the errors of thousands of hits add up.
// Why these c: validation/certified.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "signorini/model.hpp"
#include "signorini/result.hpp"

namespace signorini {

struct CompanionRun {
  Model model;
  RunSpec run;
  std::uint64_t seed = 0;
  /// Of what the rounding of modes hides of an event's time (Step::resolution beyond that of the clock): by so much of it
  /// its events are moved, either way.
  double moved = 0.0;
};

struct CompanionPlan {
  std::vector<CompanionRun> runs;
  std::string name;    ///< "exact", "ida, rtol 1e-10"
  std::string choice;  ///< "as given", or "auto: ..."
  std::string doubt;   ///< why nothing is certain by it; empty: none
  double factor = 1.0;
  double local = 1.0;    ///< part of t_uncertainty that is added: of what the difference has not seen
  double cost = 0.0;     ///< expected, of that of the run; 0: nobody knows
  double seconds = 0.0;  ///< the same of itself
  double steps = 0.0;    ///< expected, of one companion; 0: nobody knows
};

/// Gives every contact of `model` that has none the capture velocity of this run.
void hold_capture(Model& model, double capture_velocity);

/// run.engine is not automatic. Errors: SceneError where a companion is asked for that refuses the model.
[[nodiscard]] CompanionPlan plan_companion(const Model& model, const RunSpec& run);

}  // namespace signorini
