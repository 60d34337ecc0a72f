#include "run/choose_engine.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "model/decay.hpp"
#include "run/engines.hpp"
#include "run/expected.hpp"

namespace signorini {
namespace {

/// Relative to the fastest oscillation: see choose_engine.hpp.
constexpr double slow = 0.2;

}  // namespace

EngineChoice choose_engine(const Model& model, const RunSpec& run) {
  if (run.engine != Engine::automatic) return {run.engine, false, "as given"};
  const Engine closed_form = engine_for(EngineRole::closed_form),
               integrator = engine_for(EngineRole::integrator);
  if (!exact_takes(model, run))
    return {integrator, true, "a law or a load of the scene has no motion in closed form"};
  const double decay = fastest_decay(model), oscillation = std::max(model.omega_max, 1.0 / run.t_end);
  if (decay > slow * oscillation)
    return {integrator, true,
            fmt::format("the fastest decay, {:.3g} 1/{}, is not slow beside the "
                        "fastest oscillation, {:.3g} rad/{}",
                        decay, model.units.time, oscillation, model.units.time)};
  return {closed_form, true, "the laws are linear, and every decay is slow beside the fastest oscillation"};
}

}  // namespace signorini
