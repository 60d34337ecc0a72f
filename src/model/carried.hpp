// carried.hpp: forces on pendulums that the structure presses, for a start in equilibrium.
//
//   ( K + sum_k N_k / R_k t_k t_k^T ) u = P - contacts,   N_k = -N of contact k there      (src/contact/bowl.hpp)
//
// N_k depends on u and u on N_k; the fixed-point iteration converges fast, because N_k hardly depends on the lateral
// stiffness. A continued run uses the N_k of the previous run: K, its damping and the stored energy then are the same.
#pragma once

#include <functional>
#include <vector>

#include "signorini/model.hpp"

namespace signorini {

/// True if the scene has pendulums that the structure presses.
[[nodiscard]] bool has_pressed_pendulums(const Scene& scene);

/// Sets the carried force of each pendulum, one number per contact, and its N_k / R_k in K; other contacts are
/// unchanged.
void carry(const Scene& scene, const std::vector<double>& forces, Model& model);

/// Calls `start` with K of the current forces until they converge, and carries them. Errors: SceneError if they do not
/// converge.
void start_on_pendulums(const Scene& scene, Model& model, const std::function<Model(Model)>& start);

/// Carried forces of the run that this one continues, if it has any.
[[nodiscard]] std::vector<double> carried_before(const Scene& scene);

}  // namespace signorini
