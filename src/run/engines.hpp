// engines.hpp: what the loop has to know of an engine, one row an engine.
//
//   const EngineRow& engine = engine_row(run.engine);
//   engine.refuse(model, run);   method = engine.method(model, run);   stepper = engine.make(parts);
//
// The names stand in signorini/engine.hpp. What a row refuses: exact takes linear laws and forcing of a
// degree that a series reaches, newmark linear laws, friction-iteration linear laws and contact elements.
#pragma once

#include <cstdint>
#include <memory>

#include "engine/stepper.hpp"
#include "engine/tolerance.hpp"
#include "motion/mode_systems.hpp"
#include "run/effort.hpp"
#include "signorini/error.hpp"
#include "signorini/result.hpp"

namespace signorini {

struct ModalShare;

/// What engines are made of. All of it must outlive them, but for run and tolerance.
struct EngineParts {
  const Model& model;
  const Structure& structure;
  ModeSystems& systems;
  const RunSpec& run;
  const Tolerance& tolerance;
  int max_order;
  ModalShare* share = nullptr;  ///< of `exact` in modes with the observer; null: none
  bool peaks = true;            ///< somebody asks for the turning points of contacts
  bool alone = false;           ///< no observer reads its steps
  std::uint64_t step_seed = 0;  ///< MotionObserver::step_seed
};

/// An engine that does not take the scene: why, without what to use instead.
class UnfitEngine : public SceneError {
 public:
  UnfitEngine(const RunSpec& run, const std::string& what, const std::string& instead);
  std::string why;
};

struct EngineRow {
  Engine engine;
  /// Errors: UnfitEngine at run.engine, naming the contact or the load.
  void (*refuse)(const Model& model, const RunSpec& run);
  /// Order and its reason. Errors: SceneError where a step is needed and not given.
  Method (*method)(const Model& model, const RunSpec& run);
  std::unique_ptr<Stepper> (*make)(const EngineParts& parts);
  /// What the time loop will cost, by order of magnitude.
  Effort (*effort)(const EffortParts& parts);
};

/// run.engine is no longer automatic.
[[nodiscard]] const EngineRow& engine_row(Engine engine);

}  // namespace signorini
