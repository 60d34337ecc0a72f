// choose_flow.hpp: what engine `exact` computes the motion between events with.
//
//   modal    modes of each contact state (engine/exact/modal): the cost follows the motion
//   taylor   power series of the equations: the cost follows the highest frequency of the mesh
//
// Modes are taken where they can follow all of the scene and have been measured to be faster:
// from 24 unknowns on, with loads and surfaces that stand still between their jumps.
#pragma once

#include <string>

#include "signorini/model.hpp"

namespace signorini {

/// Why the flow is not modal; empty: it is.
[[nodiscard]] std::string objection_to_modes(const Model& model);

}  // namespace signorini
