// initial_state.hpp: u(0), v(0) as given by the scene.
#pragma once

#include <functional>
#include <vector>

#include "model/assembly/dofs.hpp"
#include "signorini/model.hpp"

namespace signorini::model {

struct InitialState {
  Vector u, v;  ///< one entry for each degree of freedom
};

/// The given initial values, by node or as vectors of a scene with matrices; not for initial = "static".
/// Errors: SceneError for a component that does not exist, or a nonzero value of a fixed component.
[[nodiscard]] InitialState given_state(const Scene& scene, const assembly::DofMap& map);

/// Warnings about nonzero initial values without effect on the motion, one sentence each. At a degree of freedom
/// without mass, equilibrium determines the velocity, and also the displacement unless a damper, a dashpot of a
/// contact or friction acts there. The model must have its damping, but must not be reduced and not have shear
/// elements.
[[nodiscard]] std::vector<std::string> unused_values(const Scene& scene, const assembly::DofMap& map,
                                                     const Model& model);

// Forces on pendulums whose compression follows from the structure, for a start in equilibrium.
//
//   ( K + sum_k N_k / R_k t_k t_k^T ) u = P - contact forces,   N_k = -N of contact k (contact/curved_surface.hpp)
//
// N_k depends on u and u on N_k; the fixed-point iteration converges fast, because N_k hardly depends on the
// lateral stiffness. A continued run uses the N_k of the previous run, so that K, beta K and the stored
// energy are the same.

/// True if the scene has pendulums whose compression follows from the structure (normal_spring, not a given force).
[[nodiscard]] bool has_pressed_pendulums(const Scene& scene);

/// Sets the force that each pendulum carries, and adds its stiffness N_k / R_k to K. forces: one number per
/// contact; numbers of contacts that are not pendulums are ignored.
void set_pendulum_forces(const Scene& scene, const std::vector<double>& forces, Model& model);

/// Computes the forces on pendulums by fixed-point iteration, and sets them in the model. start: returns the
/// model with its static start for given forces. Errors: SceneError if the iteration does not converge.
void solve_pendulum_start(const Scene& scene, Model& model, const std::function<Model(Model)>& start);

/// Force on each pendulum: from the saved run that the scene continues, otherwise the nominal force. One number per
/// contact; 0 for contacts that are not pendulums.
[[nodiscard]] std::vector<double> saved_pendulum_forces(const Scene& scene);

// Static start with friction, initial = "frictional": defines the stages, and takes the initial state from their result.
//
//   stage i: dP = sum of direction * f(0) over the loads of the stage;   without stages: all static loads in one stage
//   u(0) = u, v(0) = 0, anchors such that T(0) is the shear force after the last stage
//
// model/statics/frictional.hpp applies the stages.

/// Sets u0, v0, statics and the initial shear forces of contacts. Errors: SceneError for stages that name no
/// load, omit a static load or name a load twice, and for a start without equilibrium.
void start_with_friction(const Scene& scene, assembly::DofMap& map, Model& model);

}  // namespace signorini::model
