// choose_flow.hpp: what engine `exact` computes the motion between events with.
//
//   taylor   power series of the equations: the cost follows the highest frequency of the mesh
//   modal    modes of each contact state (engine/exact/modal): the cost follows the motion
//
// run.flow = "auto" takes modes where they can follow all of the scene and the mesh is fine enough to gain by
// it.
#pragma once

#include <string>

#include "signorini/model.hpp"

namespace signorini {

struct FlowChoice {
  bool modal = false;
  std::string reason;  ///< "as given" or "auto: ..."
};

/// Errors: SceneError where run.flow = "modal" and the scene has what modes cannot follow.
[[nodiscard]] FlowChoice choose_flow(const Model& model, const RunSpec& run);

}  // namespace signorini
