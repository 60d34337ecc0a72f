// initial_state.hpp: u(0), v(0) as given by the scene.
#pragma once

#include <functional>
#include <vector>

#include "model/assembly/dofs.hpp"
#include "signorini/model.hpp"

namespace signorini::model {

struct InitialState {
  Vector u, v;  ///< n
};

/// Values by node, or vectors of a matrix scene; not for initial = "static". Errors: SceneError for a component that
/// does not exist, or a nonzero value of a fixed one.
[[nodiscard]] InitialState given_state(const Scene& scene, const assembly::DofMap& map);

/// One sentence for each nonzero value without effect on the motion. Without mass a velocity follows from equilibrium,
/// and so does a displacement, unless a damper, or the dashpot or friction of a contact, needs it. The model: damping
/// set, neither reduced nor with shear elements.
[[nodiscard]] std::vector<std::string> unused_values(const Scene& scene, const assembly::DofMap& map,
                                                     const Model& model);

// Forces on pendulums that the structure presses, for a start in equilibrium.
//
//   ( K + sum_k N_k / R_k t_k t_k^T ) u = P - contacts,   N_k = -N of contact k there      (src/contact/curved_surface.hpp)
//
// N_k depends on u and u on N_k; the fixed-point iteration converges fast, because N_k hardly depends on the lateral
// stiffness. A continued run uses the N_k of the previous run: K, its damping and the stored energy then are the same.

/// True if the scene has pendulums that the structure presses.
[[nodiscard]] bool has_pressed_pendulums(const Scene& scene);

/// Sets the carried force of each pendulum, one number per contact, and its N_k / R_k in K; other contacts are
/// unchanged.
void set_pendulum_forces(const Scene& scene, const std::vector<double>& forces, Model& model);

/// Calls `start` with K of the current forces until they converge, and carries them. Errors: SceneError if they do not
/// converge.
void solve_pendulum_start(const Scene& scene, Model& model, const std::function<Model(Model)>& start);

/// Carried forces of the run that this one continues, if it has any.
[[nodiscard]] std::vector<double> saved_pendulum_forces(const Scene& scene);

// Initial = "frictional": loads of each stage, and the initial state that results.
//
//   stage i: dP = sum of its loads d f(0);    without stages: all static loads at once
//   u(0) = u, v(0) = 0, anchors such that T(0) is T at the end of the start
//
// model/statics/frictional.hpp increases the loads.

/// Sets u0, v0, statics and the shears of contacts. Errors: SceneError for stages that name no load, omit a static one
/// or name one twice, and for a start without equilibrium.
void start_with_friction(const Scene& scene, assembly::DofMap& map, Model& model);

}  // namespace signorini::model
