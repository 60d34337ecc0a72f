// choose_flow.hpp: chooses the method of engine `exact` for the motion between events.
//
//   taylor   power series of the equations: the cost follows the highest frequency of the mesh
//   modal    modes of each contact state (engine/exact/modal): the cost follows the motion
//
// run.flow = "auto" takes modes if they can compute all of the scene at lower cost (docs/theory.md):
//   real      from 16 unknowns on
//   complex   from 40 on, without rigid constraints, if the states cost at most half as much as the series
// and never in a scene whose contact states have too many springs for modes.
#pragma once

#include <string>

#include "signorini/model.hpp"

namespace signorini {

struct FlowChoice {
  bool modal = false;
  std::string reason;  ///< "as given" or "auto: ..."
};

/// Kind of modes that a scene needs, and the reason if modes cannot compute it.
struct ModalKind {
  bool damped = false;    ///< complex modes are needed
  bool crowded = false;   ///< states may have too many springs for modes, and are then left to the series
  std::string objection;  ///< empty: modes can compute the scene
};
[[nodiscard]] ModalKind modal_kind(const Model& model);
/// True if complex modes, once they are computed, cost less than the series: there are enough unknowns, and no rigid
/// contact, whose hits excite the whole mesh.
[[nodiscard]] bool damped_modes_gain(const Model& model);

/// Errors: SceneError if run.flow = "modal" and modes cannot compute the scene.
[[nodiscard]] FlowChoice choose_flow(const Model& model, const RunSpec& run);

}  // namespace signorini
