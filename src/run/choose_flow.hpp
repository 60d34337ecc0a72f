// choose_flow.hpp: what engine `exact` computes the motion between events with.
//
//   taylor   power series of the equations: the cost follows the highest frequency of the mesh
//   modal    modes of each contact state (engine/exact/modal): the cost follows the motion
//
// run.flow = "auto" takes modes where they can follow all of the scene and gain by it (docs/theory.md):
//   real      from 16 unknowns on
//   complex   from 40 on, without rigid constraints, where the states cost at most half of what the series does
// and in no scene whose contacts may have more springs than a state's modes are worth.
#pragma once

#include <string>

#include "signorini/model.hpp"

namespace signorini {

struct FlowChoice {
  bool modal = false;
  std::string reason;  ///< "as given" or "auto: ..."
};

/// Which modes can follow a scene, and what of it none can.
struct ModalKind {
  bool damped = false;   ///< complex modes are needed
  bool crowded = false;  ///< states may have more springs than modes are made for, and are left to the series
  std::string objection;  ///< empty: they can
};
[[nodiscard]] ModalKind modal_kind(const Model& model);
/// Complex modes, once they are known, are cheaper than the series: unknowns enough, and no rigid contact, whose hits
/// excite the whole mesh.
[[nodiscard]] bool damped_modes_gain(const Model& model);

/// Errors: SceneError where run.flow = "modal" and the scene has what modes cannot follow.
[[nodiscard]] FlowChoice choose_flow(const Model& model, const RunSpec& run);

}  // namespace signorini
