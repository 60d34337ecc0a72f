// companion.hpp: what a run is certified by, and whether that is worth it.
//
//   run                  companion   how                                          c, why
//   any but exact        exact       as it is                                     1.5  the difference is the
//   error ida                  finer       rtol / 100, absolute tolerances too          2    rtol / 10 is not
//   enough: at 1e-8
//                                                                                      errors are no longer ~
//                                                                                      rtol
//   steps of given dt    finer       dt / 2                                       3    4/3 of the difference
//   at order
//                                                                                      two, 2 at order one
//   exact                finer       twice, every datum off by about one rounding 5    two draws of a random
//   error
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
