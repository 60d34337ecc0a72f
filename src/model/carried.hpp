// carried.hpp: what pendulums bear where the structure presses them, at a start in equilibrium.
//
//   ( K + sum_k N_k / R_k t_k t_k^T ) u = P - contacts,   N_k = -N of contact k there      (src/contact/bowl.hpp)
//
// N_k follows from u and u from N_k, which is found by going round: N_k hardly depends on what stands across it. Where a
// run goes on from another, N_k is that run's: K, its damping and what counts as stored are then the same.
#pragma once

#include <functional>
#include <vector>

#include "signorini/model.hpp"

namespace signorini {

/// Pendulums that the structure presses.
[[nodiscard]] bool has_pressed_pendulums(const Scene& scene);

/// Sets what each pendulum bears, one number a contact, and its N_k / R_k in K; other contacts are left alone.
void carry(const Scene& scene, const std::vector<double>& forces, Model& model);

/// Calls `start` with K of the forces found so far until they stay, and carries them. Errors: SceneError where they do
/// not settle.
void start_on_pendulums(const Scene& scene, Model& model, const std::function<Model(Model)>& start);

/// Those of the run that this one goes on from, where it has them.
[[nodiscard]] std::vector<double> carried_before(const Scene& scene);

}  // namespace signorini
