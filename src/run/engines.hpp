// engines.hpp: table of engines, one row per engine.
//
//   const EngineRow& engine = engine_row(run.engine);
//   engine.refuse(model, run);   method = engine.method(model, run);   stepper = engine.make(parts);
//   if (engine.capabilities.supports_orbits) ...;   run.engine = engine_for(EngineRole::closed_form);
//
// Code that needs an engine asks for capabilities or for a role, never for a name. To add an engine, add a row in
// signorini/engine.hpp, a row here, and a folder with the engine.
//
// The names are in signorini/engine.hpp. Accepted scenes: exact needs linear laws, and polynomial forcing of limited
// degree; newmark needs linear laws; friction-iteration needs linear laws and contact elements; ida accepts every scene.
#pragma once

#include <memory>

#include "engine/stepper.hpp"
#include "engine/tolerance.hpp"
#include "motion/state_systems.hpp"
#include "run/cost_estimate.hpp"
#include "run/run_listener.hpp"
#include "signorini/error.hpp"
#include "signorini/result.hpp"

namespace signorini::run {

/// Data from which an engine is made. All referenced objects except run and tolerance must outlive the engine.
struct EngineParts {
  const Model& model;
  const linear::SystemMatrices& structure;
  motion::StateSystems& systems;
  const RunSpec& run;
  const engine::Tolerance& tolerance;
  int max_order;
  ListenerNeeds needs = {};
  bool without_listeners = false;  ///< no listener reads the engine's steps
  /// Indices of u and v that DenseOutput::evaluate_watched computes in addition to those of contacts; nullopt: all.
  std::optional<std::vector<int>> watched = {};
};

/// Error: an engine does not accept the scene. reason: the message without its recommendation.
class UnsupportedSceneError : public SceneError {
 public:
  UnsupportedSceneError(const RunSpec& run, const std::string& what, const std::string& instead);
  std::string reason;
};

/// Roles of engines; at most one engine has each role.
enum class EngineRole : unsigned char {
  none,
  /// The motion between events is exact up to rounding. Chosen automatically for accepted scenes of low cost; companion
  /// run of all other engines.
  closed_form,
  /// Accepts every scene. Chosen automatically if closed_form is not; companion run of fixed steps if exact refuses the scene.
  integrator,
  fixed_steps,  ///< independent method for `verify`, which halves its steps
};

struct EngineCapabilities {
  /// The motion between events is exact; run.flow chooses how it is computed.
  bool closed_form_flow = false;
  bool supports_orbits = false;       ///< periodic orbits can be computed with this engine
  bool discrete_derivatives = false;  ///< sensitivity/discrete_run.hpp can differentiate the engine's steps
  bool laws_at_step_ends = false;     ///< contact laws are satisfied at the ends of the engine's steps
  /// True if the engine locates the zeros of guards.
  bool (*locates_events)(const RunSpec& run) = nullptr;
  /// Value of Stepper::resolves_low_flights for this model.
  bool (*resolves_low_flights)(const Model& model) = nullptr;
};

struct EngineRow {
  Engine engine;
  EngineRole role;
  EngineCapabilities capabilities;
  /// Errors: UnsupportedSceneError at run.engine, with the name of the contact or the load.
  void (*refuse)(const Model& model, const RunSpec& run);
  /// Method with its order and reason. Errors: SceneError if the engine requires run.dt and the scene has none.
  Method (*method)(const Model& model, const RunSpec& run);
  std::unique_ptr<engine::Stepper> (*make)(const EngineParts& parts);
  /// Estimated cost of the time loop, as an order of magnitude.
  CostEstimate (*estimate_cost)(const CostInputs& parts);
};

/// Row of this engine, which must not be Engine::automatic.
[[nodiscard]] const EngineRow& engine_row(Engine engine);
/// The engine with this role, which must not be EngineRole::none.
[[nodiscard]] Engine engine_for(EngineRole role);
/// Names of the engines with this capability, for messages: "\"exact\" or \"ida\"".
[[nodiscard]] std::string engines_that(bool EngineCapabilities::*can);

}  // namespace signorini::run
