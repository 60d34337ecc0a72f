// companion.hpp: what a run is certified by, and whether that is worth it.
//
//   run              companion  how                                            c
//   any but exact    exact      as it is                                       1.5
//   ida              finer      rtol / 100, absolute tolerances too            2
//   steps of given   finer      dt / 2                                         3
//   exact            finer      twice, every datum off by about one rounding   5
//
// Why these c. Beside exact the difference is the error. At 1e-8 ida's errors are no longer ~ rtol, and
// rtol / 10 is not enough. With half the step the error is 4/3 of the difference at order two, 2 at order
// one. Exact beside itself is two draws of a random error.
//
// Beside exact the difference contains ida's own local error: a tenth of t_uncertainty is added, for what
// guards that graze hide of it. Else all of it, since the companion's own error is not known.
//
// Velocities below which rebounds rest are the run's own in all of them. Why these c: validation/certified.
#pragma once

#include <string>
#include <vector>

#include "signorini/model.hpp"
#include "signorini/result.hpp"

namespace signorini {

struct CompanionRun {
  Model model;
  RunSpec run;
};

struct CompanionPlan {
  std::vector<CompanionRun> runs;
  std::string name;    ///< "exact", "ida, rtol 1e-10"
  std::string choice;  ///< "as given", or "auto: ..."
  double factor = 1.0;
  double local = 1.0;  ///< part of t_uncertainty that is added: of what the difference has not seen
  double cost = 0.0;   ///< expected, of that of the run; 0: nobody knows
  double steps = 0.0;  ///< expected, of one companion; 0: nobody knows
};

/// run.engine is not automatic. Errors: SceneError where a companion is asked for that refuses the model.
[[nodiscard]] CompanionPlan plan_companion(const Model& model, const RunSpec& run);

}  // namespace signorini
