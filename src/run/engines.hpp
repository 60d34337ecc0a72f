// engines.hpp: what there is to know of an engine, one row an engine.
//
//   const EngineRow& engine = engine_row(run.engine);
//   engine.refuse(model, run);   method = engine.method(model, run);   stepper = engine.make(parts);
//   if (engine.can.follow_orbits) ...;   run.engine = engine_for(EngineRole::closed_form);
//
// Whoever needs something of an engine asks for what it can do or for its role, never for its name: a further engine is a row
// in signorini/engine.hpp, a row here, and its folder.
//
// The names stand in signorini/engine.hpp. What a row refuses: exact takes linear laws and forcing of a
// degree that a series reaches, newmark linear laws, friction-iteration linear laws and contact elements.
#pragma once

#include <memory>

#include "engine/stepper.hpp"
#include "engine/tolerance.hpp"
#include "motion/mode_systems.hpp"
#include "run/effort.hpp"
#include "run/run_listener.hpp"
#include "signorini/error.hpp"
#include "signorini/result.hpp"

namespace signorini {

/// What engines are made of. All of it must outlive them, but for run and tolerance.
struct EngineParts {
  const Model& model;
  const Structure& structure;
  ModeSystems& systems;
  const RunSpec& run;
  const Tolerance& tolerance;
  int max_order;
  ListenerNeeds needs = {};
  bool alone = false;  ///< no listener reads its steps
  /// Entries of u and v for DenseOutput::evaluate_watched, beside those of contacts; nullopt: all.
  std::optional<std::vector<int>> watched = {};
};

/// An engine that does not take the scene: why, without what to use instead.
class UnfitEngine : public SceneError {
 public:
  UnfitEngine(const RunSpec& run, const std::string& what, const std::string& instead);
  std::string why;
};

/// What engines stand for beside and instead of each other; each has one engine at most.
enum class EngineRole : unsigned char {
  none,
  closed_form,  ///< the flow to rounding: automatic where it takes the scene and is cheap, the companion of all others
  integrator,  ///< takes every scene: automatic where closed_form does not take it, the companion of fixed steps
  fixed_steps,  ///< the independent method that verifications halve the steps of
};

struct EngineAbilities {
  bool closed_flow = false;           ///< between events its motion is exact: run.flow is a choice of how
  bool follow_orbits = false;         ///< its motion or its tangents close an orbit
  bool discrete_derivatives = false;  ///< sensitivity/discrete_run.hpp differentiates its steps
  bool laws_at_ends = false;          ///< the laws of contacts hold at the ends of its steps
  /// It finds the times at which guards are zero.
  bool (*locates_events)(const RunSpec& run) = nullptr;
  /// Stepper::knows_low_flights.
  bool (*knows_low_flights)(const Model& model) = nullptr;
};

struct EngineRow {
  Engine engine;
  EngineRole role;
  EngineAbilities can;
  /// Errors: UnfitEngine at run.engine, naming the contact or the load.
  void (*refuse)(const Model& model, const RunSpec& run);
  /// Order and its reason. Errors: SceneError where a step is needed and not given.
  Method (*method)(const Model& model, const RunSpec& run);
  std::unique_ptr<Stepper> (*make)(const EngineParts& parts);
  /// Estimated cost of the time loop, as an order of magnitude.
  Effort (*effort)(const EffortParts& parts);
};

/// run.engine is no longer automatic.
[[nodiscard]] const EngineRow& engine_row(Engine engine);
/// The engine of that role, which is not none.
[[nodiscard]] Engine engine_for(EngineRole role);
/// "\"exact\" or \"ida\"": those that can.
[[nodiscard]] std::string engines_that(bool EngineAbilities::*can);

}  // namespace signorini
