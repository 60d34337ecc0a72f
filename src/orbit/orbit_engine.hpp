// orbit_engine.hpp: which engine computes orbits, and to what.
//
//   auto:   exact, unless it refuses the scene or a period has more than 2000 decay times of the fastest decay
//   flow:   auto takes complex modes where they can follow the scene: states' modes are kept over all periods
//   error:  exact 0, ida 100 rtol: of a state over the amplitude, with which an orbit is closed
//
// A run of a period is short, and many of them are compared: closed form is worth a few more steps than in one long run
// (run/choose_engine.hpp).
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// duration: of a period, or of what is known of it; in the units of model and run.
[[nodiscard]] Engine orbit_engine(const Model& model, const RunSpec& run, double duration);

/// run.engine: as orbit_engine() has it.
[[nodiscard]] Flow orbit_flow(const Model& model, const RunSpec& run);

[[nodiscard]] double orbit_state_error(const RunSpec& run);

}  // namespace signorini
