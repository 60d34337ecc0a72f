// scales.hpp: typical magnitudes of a scene, for default absolute tolerances.
//
//   force         largest static reaction, compression, load amplitude
//   displacement  largest static deflection, initial displacement, static response to a load amplitude; if there
//                 is none, static response to a slider's friction limit
//   (a pulse that is too short for the structure enters with its effective amplitude: model_warnings.hpp)
//   velocity      omega * displacement, at least the initial velocity
//   rotation = displacement / L,  angular velocity = velocity / L      L: diagonal of the structure
//
// omega: lowest frequency with the initially closed contacts fixed; if there is none, with only the normals of closed
// rigid contacts fixed. omega * displacement is at most sqrt(F displacement / mass), where F is the larger of the force
// scale and |K u0|; without an omega, this bound is used instead.
#pragma once

#include <vector>

#include "model/assembly/dofs.hpp"
#include "signorini/model.hpp"

namespace signorini::model {

/// All scales are positive and finite; a scale that the scene does not determine is 1. The rest of the model
/// must be complete. closed: initially closed contacts.
[[nodiscard]] Scales find_scales(const Model& model, const assembly::DofMap& map,
                                 const std::vector<bool>& closed, double t_end);

}  // namespace signorini::model
