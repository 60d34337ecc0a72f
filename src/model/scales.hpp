// scales.hpp: typical magnitudes of a scene, on which default absolute tolerances stand.
//
//   force         greatest static reaction, compression, load amplitude
//   displacement  greatest static deflection, initial displacement, static answer to a load amplitude; where
//                 there is none, static answer to a slider's friction limit
//   (a pulse that is too short for the structure counts with less than its amplitude: felt.hpp)
//   velocity      omega * displacement, at least the initial velocity
//   rotation = displacement / L,  angular velocity = velocity / L      L: diagonal of the structure
//
// omega: lowest frequency with the initially closed contacts held, else with all contacts free. omega *
// displacement is at most sqrt(F displacement / mass), F the greater of the force scale and |K u0|, and is
// that where there is no omega.
#pragma once

#include <vector>

#include "model/assembly/dofs.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// Everything else of the model must be there. All scales are positive and finite; what nothing in the
/// scene determines is 1.
[[nodiscard]] Scales find_scales(const Model& model, const DofMap& map, const std::vector<bool>& closed,
                                 double t_end);

}  // namespace signorini
