// p_delta.hpp: P-delta in two passes (run.geometric).
//
//   first:   K u = P - contact forces,  prestress: axial forces of members and forces on rigid bodies
//   second:  (K + K_g) u = P - contact forces,  the initial state of a static start
//
// A frictional start is computed with K alone. Then K_g is applied as one more stage, which begins with the contact
// states at the end of the last stage:
//
//   (K + K_g) u' = dP - K_g u_1     u_1: u at the end of the last stage, dP: K_g terms of moved supports
//
// A continued run uses the prestress of the previous run. A run with a given initial state uses the prestress of a
// static start; the structure may then be unstable while contacts are open.
#pragma once

#include "model/modes/modes.hpp"
#include "model/statics/frictional.hpp"
#include "model/statics/statics.hpp"

namespace signorini::model {

struct FirstPass {
  Prestress forces;
  std::vector<bool> closed;  ///< one entry per contact; empty if the forces come from another run
};

/// First pass of a start without friction: the prestress of its equilibrium, or of the continued run. Errors: SceneError if
/// there is no equilibrium.
[[nodiscard]] FirstPass first_pass(const Scene& scene, const assembly::DofMap& map, const Model& model);

/// Sets Model::geometric, stores the prestress in the map, and adds the stiffness of the prestress to the model and to
/// the loads of supports.
void apply_prestress(const Scene& scene, Prestress forces, assembly::DofMap& map, Model& model);

/// Second pass of a start without friction. Errors: SceneError if the structure buckles under its static
/// loads.
[[nodiscard]] statics::Equilibrium second_pass(const Scene& scene, const assembly::DofMap& map,
                                               const Model& model, const std::vector<bool>& closed);

/// Second pass of a frictional start: takes the forces after the last stage as prestress, and applies their geometric
/// stiffness as one more stage. acts: for each load, true if it is applied at the start. Errors: SceneError if the
/// structure buckles.
[[nodiscard]] statics::FrictionalEquilibrium second_pass_frictional(const Scene& scene,
                                                                    const std::vector<bool>& acts,
                                                                    statics::FrictionalEquilibrium found,
                                                                    assembly::DofMap& map, Model& model);

/// Sets the load factors of Model::geometric. closed: the closed contacts, which stick if they have friction;
/// after a frictional start, the contact states of its last stage are used instead.
void set_load_factors(const Scene& scene, const assembly::DofMap& map, const std::vector<bool>& closed,
                      Model& model);

}  // namespace signorini::model
