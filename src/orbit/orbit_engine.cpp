#include "orbit/orbit_engine.hpp"

#include "model/slip_growth.hpp"
#include "run/choose_engine.hpp"
#include "run/cost_estimate.hpp"
#include "run/engines.hpp"

namespace signorini::orbit {
namespace {

// Limit for period / shortest decay time: a series needs one step per 5 decay times, thus up to 400 steps per
// period. Chosen value.
constexpr double max_decays = 2000.0;
// Error of a state / (rtol amplitude): errors of steps accumulate over a period. Chosen value.
constexpr double error_per_rtol = 100.0;

}  // namespace

Engine orbit_engine(const Model& model, const RunSpec& run, double duration) {
  if (run.engine != Engine::automatic) return run.engine;
  if (!run::exact_accepts(model, run)) return run::engine_for(run::EngineRole::integrator);
  if (model::fastest_decay(model) * duration <= max_decays)
    return run::engine_for(run::EngineRole::closed_form);
  return run::choose_engine(model, run).engine;
}

Flow orbit_flow(const Model& model, const RunSpec& run) {
  if (run.flow != Flow::automatic || !run::engine_row(run.engine).capabilities.closed_form_flow)
    return run.flow;
  const run::ModalKind kind = run::modal_kind(model);
  const bool can = kind.objection.empty() && kind.damped && !kind.too_many_springs;
  return can && run::damped_modes_are_faster(model) ? Flow::modal : run.flow;
}

double orbit_state_error(const RunSpec& run) {
  return engine_info(run.engine).accuracy == Accuracy::tolerance ? error_per_rtol * run.rtol : 0.0;
}

}  // namespace signorini::orbit
