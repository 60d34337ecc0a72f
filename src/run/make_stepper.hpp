// make_stepper.hpp: the engine that a run asks for, and what it makes of the settings.
#pragma once

#include <memory>

#include "engine/stepper.hpp"
#include "motion/mode_systems.hpp"
#include "signorini/result.hpp"

namespace signorini {

/// spec.engine is no longer `automatic`. Fills settings: engine, order, step. The others must outlive the
/// stepper, but for settings. Errors: SceneError where a step is needed and not given.
[[nodiscard]] std::unique_ptr<Stepper> make_stepper(const Model& model, const Structure& structure,
                                                    ModeSystems& systems, const RunSpec& spec,
                                                    Settings& settings);

}  // namespace signorini
