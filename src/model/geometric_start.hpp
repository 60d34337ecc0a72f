// geometric_start.hpp: P-delta in two passes (run.geometric).
//
//   first:   K u = P - contacts,  which gives the axial forces of members and the forces on rigid bodies, frozen
//   second:  (K + K_g) u = P - contacts,  the state in which a static start begins
//
// A frictional start comes to its end by K alone; then K_g grows on the states of its contacts as one more stage,
//
//   (K + K_g) u' = dP - K_g u_1     u_1: at the end of the last stage, dP: what K_g adds for supports that moved
//
// A run that goes on from another has that run's forces. A given start has those of the static start, which need not be
// stable where contacts are open then.
#pragma once

#include "model/modes/modes.hpp"
#include "model/statics/frictional.hpp"
#include "model/statics/statics.hpp"

namespace signorini {

struct FirstPass {
  FrozenForces forces;
  std::vector<bool> closed;  ///< one a contact; none where the forces are those of another run
};

/// Of a start without friction. Errors: SceneError where there is no equilibrium.
[[nodiscard]] FirstPass first_pass(const Scene& scene, const DofMap& map, const Model& model);

/// Sets Model::geometric, freezes the forces and adds their stiffness to the model, and to the loads of supports.
void stiffen(const Scene& scene, FrozenForces forces, DofMap& map, Model& model);

/// Errors: SceneError where the structure buckles under its static loads.
[[nodiscard]] Equilibrium second_pass(const Scene& scene, const DofMap& map, const Model& model,
                                      const std::vector<bool>& closed);

/// Freezes the forces at the end of a frictional start and lets their stiffness grow; acts: one a load.
/// Errors: SceneError where the structure buckles.
[[nodiscard]] FrictionalEquilibrium stiffened_end(const Scene& scene, const std::vector<bool>& acts,
                                                  FrictionalEquilibrium found, DofMap& map, Model& model);

/// Sets Model::geometric's load factors, on contacts that are closed; of a frictional start: in their states.
void set_load_factors(const Scene& scene, const DofMap& map, const std::vector<bool>& closed, Model& model);

}  // namespace signorini
