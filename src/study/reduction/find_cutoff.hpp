// find_cutoff.hpp: the cutoff that a tolerance asks for.
//
//   few modes -> run -> what the modes left out would have added (left_out.hpp) -> more modes -> run -> ...
//   error = |u - u_finer| + missed_finer max(1, error / missed)
//   the first trial with error <= tolerance is in force
//
// What is missed changes contact forces, which sends waves on, shifts events and may change their sequence: no
// estimate from one run knows of that, nor of forces that jump between its samples. So a trial is set beside a run with
// at least twice the cutoff, at all instants at which both have samples; what that one still misses moves it, too, as far
// as what the trial missed moved that, in all: not only up to the finer one. If the finer one has all modes, the error is
// the difference from the full model.
// Relative: to the greatest displacement of all places that are asked for, in the run.
#pragma once

#include <functional>
#include <optional>

#include "signorini/scene.hpp"

namespace signorini {

/// Errors: SceneError at reduction.tolerance where modes cannot be found so, or a trial run stops.
/// go_on: asked now and then; false ends the search with the scene as it is.
[[nodiscard]] Scene find_cutoff(
    Scene scene, const std::function<bool()>& go_on = [] { return true; });

/// The cutoff of another scene that asked for the same tolerance, or else its own: runs that are compared are
/// those of one model, which is looked for once.
[[nodiscard]] Scene find_cutoff(Scene scene, const std::optional<ReductionSpec>& found);

}  // namespace signorini
