// simulate.hpp: computes the motion of a model.
//
//   0 = u' - v
//   0 = M v' + C v + K u - P(t) + sum_k ( n_k N_k + t_k T_k )
//   0 = two rows for each contact, chosen by its state (contact.hpp)
//
// The time loop. x = (u, v, N, T); x- is its value just before an instant, x+ just after: u- = u+ always, v jumps at impacts,
// N and T at jumps of loads or when friction drops to its kinetic value. The contact states are valid on [t, t'). At t' a
// guard is no longer positive, or there is a breakpoint: the forcing P, the compression of a slider or the motion of a
// surface is not smooth.
//
//   x-, states- <- u0, v0, guessed from the gaps
//   x+, states+ <- decide(x-, states-) at t = 0        record the impacts, and an output row at 0
//   while t < t_end:
//     end <- the next breakpoint, or t_end
//     engine.start(x+, states+, end)                   no guard reaches zero at t itself: states+ is valid there
//     repeat:
//       (t0, t1], triggered <- engine.advance()        t1: the first zero crossing of a guard, if any
//       record output rows in [t0, t1), and rows for pictures; add work, update extremes
//       t <- t1, x- <- x(t1) in states+
//     until a guard was triggered at t, or t >= end
//     x+, states+ <- decide(x-, states-, triggered, P-, P+)    all states at once, in as many rounds as needed
//                                                      (an engine that finds states itself keeps them)
//     record an event for every contact whose state has changed (event.hpp), and an output row at t: x+
//   stop early if no states are consistent, the engine fails, events repeat without progress in time,
//   or the recorder ends the run
//
//   Scene scene = read_scene("models/pipeline.toml");
//   Result result = simulate(scene);
#pragma once

#include "signorini/model.hpp"
#include "signorini/result.hpp"

namespace signorini {

/// Runs to settings.t_end; the recorder receives rows during the run. A run that cannot continue does not throw; the Outcome
/// in the Report then contains time, place and reason. Errors: SceneError if the engine refuses the scene.
[[nodiscard]] Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder);

/// Runs to settings.t_end and returns all rows in a Result.
[[nodiscard]] Result simulate(const Model& model, const RunSpec& settings);

/// Simulates a scene with the scene's run settings. Errors: also those of build_model().
Report simulate(const Scene& scene, Recorder& recorder);
[[nodiscard]] Result simulate(const Scene& scene);

/// State of a run at its last row, for Scene::initial.saved: displacements, velocities, shear forces of contacts, and states
/// and memories of user laws. Errors: std::invalid_argument if there is no row.
[[nodiscard]] SavedState last_state(const Model& model, const Result& result);

}  // namespace signorini
