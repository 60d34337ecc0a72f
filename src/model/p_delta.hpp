// p_delta.hpp: P-delta in two passes (run.geometric).
//
//   first:   K u = P - contacts,  gives the axial forces of members and the forces on rigid bodies, frozen
//   second:  (K + K_g) u = P - contacts,  the initial state of a static start
//
// A frictional start ends with K alone; then K_g grows, with the contact states at that end, as one more stage,
//
//   (K + K_g) u' = dP - K_g u_1     u_1: at the end of the last stage, dP: K_g terms of moved supports
//
// A continued run uses the forces of the previous run. A given start uses those of the static start, which then may be
// unstable while contacts are open.
#pragma once

#include "model/modes/modes.hpp"
#include "model/statics/frictional.hpp"
#include "model/statics/statics.hpp"

namespace signorini::model {

struct FirstPass {
  Prestress forces;
  std::vector<bool> closed;  ///< one per contact; empty if the forces come from another run
};

/// First pass of a start without friction. Errors: SceneError if there is no equilibrium.
[[nodiscard]] FirstPass first_pass(const Scene& scene, const assembly::DofMap& map, const Model& model);

/// Sets Model::geometric, freezes the forces and adds their stiffness to the model and to the loads of supports.
void apply_prestress(const Scene& scene, Prestress forces, assembly::DofMap& map, Model& model);

/// Errors: SceneError where the structure buckles under its static loads.
[[nodiscard]] statics::Equilibrium second_pass(const Scene& scene, const assembly::DofMap& map,
                                               const Model& model, const std::vector<bool>& closed);

/// Freezes the forces at the end of a frictional start and increases their stiffness; acts: one per load. Errors:
/// SceneError if the structure buckles.
[[nodiscard]] statics::FrictionalEquilibrium second_pass_frictional(const Scene& scene,
                                                                    const std::vector<bool>& acts,
                                                                    statics::FrictionalEquilibrium found,
                                                                    assembly::DofMap& map, Model& model);

/// Sets Model::geometric's load factors, with contacts closed; for a frictional start with their states.
void set_load_factors(const Scene& scene, const assembly::DofMap& map, const std::vector<bool>& closed,
                      Model& model);

}  // namespace signorini::model
