// find_cutoff.hpp: finds the cutoff for a given tolerance.
//
//   few modes -> run -> contribution of the modes left out (left_out.hpp) -> more modes -> run -> ...
//   error = |u - u_finer| + missed_finer max(1, error / missed)
//   the first trial with error <= tolerance is used
//
// The missing contribution changes contact forces, which emit waves, shift events and may change their sequence. An
// estimate from one run includes none of this, nor forces that jump between its samples. So a trial is compared with a
// run with at least twice the cutoff, at all common sample instants. The contribution that the finer run still misses
// also changes the motion; its effect is scaled by the ratio of error to contribution that the trial showed. If the
// finer run has all modes, the error is the difference from the full model.
// Errors are relative to the largest displacement of all requested places in the run.
#pragma once

#include <functional>
#include <optional>

#include "signorini/scene.hpp"

namespace signorini {

/// Errors: SceneError at reduction.tolerance if no modes satisfy it, or if a trial run stops. go_on: called
/// periodically; false ends the search with the scene unchanged.
[[nodiscard]] Scene find_cutoff(
    Scene scene, const std::function<bool()>& go_on = [] { return true; });

/// The cutoff found for another scene with the same tolerance, or else its own: compared runs use one model, and the
/// search is done once.
[[nodiscard]] Scene find_cutoff(Scene scene, const std::optional<ReductionSpec>& found);

}  // namespace signorini
