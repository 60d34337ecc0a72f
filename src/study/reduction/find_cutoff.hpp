// find_cutoff.hpp: the cutoff that a tolerance asks for.
//
//   few modes -> run -> what the modes left out would have added (left_out.hpp)
//   error = missed max(1, |u - u_before| / missed_before)
//   while that is above the tolerance: more modes, as many as its fall with the cutoff asks for
//
// What is missed would change contact forces and shift events, which changes displacements by more: by how much, the
// difference of two trials tells beside what the first of them missed. So there are two trials at least.
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
