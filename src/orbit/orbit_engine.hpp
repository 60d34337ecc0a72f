// orbit_engine.hpp: choice of the engine for orbits, and its accuracy.
//
//   auto:   exact, unless it refuses the scene or a period has more than 2000 decay times of the fastest decay
//   flow:   auto uses complex modes if they can follow the scene: modes of contact states are kept over all periods
//   error:  exact 0, ida 100 rtol: error of a state over the amplitude, the limit for closing an orbit
//
// A run of one period is short, and many of them are compared: the closed form is worth a few more steps than in one
// long run (run/choose_engine.hpp).
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// duration: length of a period, or an estimate of it; in the units of model and run.
[[nodiscard]] Engine orbit_engine(const Model& model, const RunSpec& run, double duration);

/// run.engine must be the result of orbit_engine().
[[nodiscard]] Flow orbit_flow(const Model& model, const RunSpec& run);

[[nodiscard]] double orbit_state_error(const RunSpec& run);

}  // namespace signorini
