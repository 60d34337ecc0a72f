// engines.hpp: table of engines, one row per engine.
//
//   const EngineRow& engine = engine_row(run.engine);
//   engine.refuse(model, run);   method = engine.method(model, run);   stepper = engine.make(parts);
//   if (engine.can.supports_orbits) ...;   run.engine = engine_for(EngineRole::closed_form);
//
// Code that needs an engine asks for abilities or for a role, never for a name: to add an engine, add a row in
// signorini/engine.hpp, a row here, and its folder.
//
// The names are in signorini/engine.hpp. Scenes that a row accepts: exact needs linear laws, and forcing of a degree
// that a series reaches; newmark needs linear laws; friction-iteration needs linear laws and contact elements.
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

/// Data for making an engine. All referenced objects must outlive the engine, except run and tolerance.
struct EngineParts {
  const Model& model;
  const linear::SystemMatrices& structure;
  motion::StateSystems& systems;
  const RunSpec& run;
  const engine::Tolerance& tolerance;
  int max_order;
  ListenerNeeds needs = {};
  bool without_listeners = false;  ///< no listener reads its steps
  /// Entries of u and v for DenseOutput::evaluate_watched, in addition to those of contacts; nullopt: all.
  std::optional<std::vector<int>> watched = {};
};

/// Error of an engine that does not accept the scene. reason: the message without the recommendation.
class UnsupportedSceneError : public SceneError {
 public:
  UnsupportedSceneError(const RunSpec& run, const std::string& what, const std::string& instead);
  std::string reason;
};

/// Roles of engines; at most one engine has each role.
enum class EngineRole : unsigned char {
  none,
  /// The flow is exact to rounding. Chosen automatically for accepted scenes of low cost; companion of all
  /// other engines.
  closed_form,
  integrator,   ///< accepts every scene: automatic for other scenes, companion of fixed steps
  fixed_steps,  ///< independent method for verifications, which halve its steps
};

struct EngineCapabilities {
  bool closed_form_flow = false;      ///< the motion between events is exact; run.flow chooses its method
  bool supports_orbits = false;       ///< orbits can be closed with its motion or its tangents
  bool discrete_derivatives = false;  ///< sensitivity/discrete_run.hpp differentiates its steps
  bool laws_at_step_ends = false;     ///< the laws of contacts hold at the ends of its steps
  /// True if the engine locates the zeros of guards.
  bool (*locates_events)(const RunSpec& run) = nullptr;
  /// Value of Stepper::resolves_low_flights.
  bool (*resolves_low_flights)(const Model& model) = nullptr;
};

struct EngineRow {
  Engine engine;
  EngineRole role;
  EngineCapabilities capabilities;
  /// Errors: UnsupportedSceneError at run.engine, with the name of the contact or the load.
  void (*refuse)(const Model& model, const RunSpec& run);
  /// Order and its reason. Errors: SceneError if a step is required and not given.
  Method (*method)(const Model& model, const RunSpec& run);
  std::unique_ptr<engine::Stepper> (*make)(const EngineParts& parts);
  /// Estimated cost of the time loop, as an order of magnitude.
  CostEstimate (*estimate_cost)(const CostInputs& parts);
};

/// Row of this engine, which must not be Engine::automatic.
[[nodiscard]] const EngineRow& engine_row(Engine engine);
/// The engine with this role, which must not be EngineRole::none.
[[nodiscard]] Engine engine_for(EngineRole role);
/// Names of the engines with an ability, as in "\"exact\" or \"ida\"".
[[nodiscard]] std::string engines_that(bool EngineCapabilities::*can);

}  // namespace signorini::run
