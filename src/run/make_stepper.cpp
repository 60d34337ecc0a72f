#include "run/make_stepper.hpp"

#include <fmt/core.h>

#include "engine/exact/exact_engine.hpp"
#include "engine/ida/ida_engine.hpp"
#include "engine/ida/order.hpp"
#include "engine/newmark/friction_iteration.hpp"
#include "engine/newmark/newmark_engine.hpp"
#include "run/refusals.hpp"

namespace signorini {
namespace {

/// Settings of the engines whose steps have a given length.
void name_fixed_steps(const RunSpec& spec, Settings& settings) {
  if (!spec.dt)
    throw SceneError(spec.place, "run.dt",
                     fmt::format("engine \"{}\" needs it: its step", to_string(spec.engine)));
  settings.max_order = 2;
  settings.max_order_reason = "average acceleration";
  settings.dt = *spec.dt;
}

}  // namespace

std::unique_ptr<Stepper> make_stepper(const Model& model, const Structure& structure, ModeSystems& systems,
                                      const RunSpec& spec, Settings& settings) {
  settings.engine = to_string(spec.engine);
  switch (spec.engine) {
    case Engine::exact:
      settings.max_order = most_levels;
      settings.max_order_reason = "Taylor series as long as rounding needs; rtol has no part in it";
      return std::make_unique<ExactEngine>(model, structure, systems, spec.t_end);
    case Engine::newmark:
      name_fixed_steps(spec, settings);
      return std::make_unique<NewmarkEngine>(model, structure, systems, spec, settings);
    case Engine::friction_iteration:
      name_fixed_steps(spec, settings);
      return std::make_unique<FrictionIteration>(model, structure, spec);
    case Engine::automatic:
    case Engine::ida:
      break;
  }
  choose_order(model, spec, settings);
  return std::make_unique<IdaEngine>(model, structure, systems, settings, spec.t_end);
}

}  // namespace signorini
