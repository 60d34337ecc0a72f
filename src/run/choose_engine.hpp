// choose_engine.hpp: chooses the engine of a scene with engine = "auto", and the flow of engine exact.
//
//   exact   if the laws are linear and every decay is slow relative to the fastest oscillation:
//           alpha + beta omega_max^2, C_ii / M_ii and, without mass, K_ii / C_ii are at most
//           0.2 max(omega_max, 1 / t_end)
//   ida     otherwise
//
// Reason: validation/work-precision. A series takes a step for every 5 radians of the fastest motion, even after this
// motion has decayed; an implicit method takes longer steps then. Without decay the series costs least, except at low
// accuracy. Both engines cost the same if (fastest decay) / (fastest oscillation) is between 0.1 (slow loads, few events)
// and 0.5 (many events); 0.2 is a compromise.
#pragma once

#include <string>

#include "signorini/model.hpp"

namespace signorini::run {

struct EngineChoice {
  Engine engine = Engine::automatic;
  bool automatic = false;
  std::string reason;  ///< one sentence
};

/// Returns run.engine with the reason "as given", or the chosen engine if run.engine is automatic.
[[nodiscard]] EngineChoice choose_engine(const Model& model, const RunSpec& run);

// Chooses the method of engine `exact` for the motion between events.
//
//   taylor   power series of the equations: the number of steps grows with the highest frequency of the mesh
//   modal    modes of each contact state (engine/exact/modal): the number of steps grows with the excited frequencies
//
// run.flow = "auto" chooses modes if they can compute the whole scene at lower cost (docs/theory.md):
//   real      from 16 unknowns on
//   complex   from 40 unknowns on, without rigid contacts, if the modes of all contact states cost at most half as much
//             as the series
//
// "auto" never chooses modes for a scene whose contact states may have too many springs for modes.

struct FlowChoice {
  bool modal = false;
  std::string reason;  ///< "as given" or "auto: ..."
};

/// Kind of modes that a scene needs, and the reason if modes cannot compute its motion.
struct ModalKind {
  bool damped = false;  ///< complex modes are needed, because damping is not proportional
  /// Some contact states may have too many springs for modes and need the series.
  bool too_many_springs = false;
  std::string objection;  ///< empty: modes can compute the scene
};
/// Kind of modes that this model needs.
[[nodiscard]] ModalKind modal_kind(const Model& model);
/// True if complex modes, apart from the cost of computing them, are faster than the series: the model has enough
/// unknowns, and no rigid contact whose hits excite the whole mesh.
[[nodiscard]] bool damped_modes_are_faster(const Model& model);

/// Flow of engine exact for this run. Errors: SceneError if run.flow = "modal" and modes cannot compute the scene.
[[nodiscard]] FlowChoice choose_flow(const Model& model, const RunSpec& run);

}  // namespace signorini::run
