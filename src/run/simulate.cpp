// Runs a model and reports: converts to the units of the computation, and back.
#include "signorini/simulate.hpp"

#include <chrono>
#include <utility>

#include "model/rescale.hpp"
#include "run/apart.hpp"
#include "run/choose_engine.hpp"
#include "run/expected.hpp"
#include "run/loop.hpp"
#include "run/physical.hpp"
#include "run/warnings.hpp"
#include "scene/quantities.hpp"

namespace signorini {

Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder) {
  return simulate(model, settings, recorder, RoundListener());
}

namespace {

RunEnd run_whole(Model& model, const RunSpec& spec, const EngineRow& engine, Method method,
                 Recorder& recorder, RunHooks hooks) {
  Loop loop(model, spec, engine, std::move(method), recorder, std::move(hooks));
  loop.begin();
  loop.advance_to(spec.t_end);
  return loop.end();
}

/// Report in the units of the scene, with the warnings about a finished run.
Report concluded(RunEnd ending, const Model& computed, const RunSpec& spec) {
  Report report = physical(std::move(ending.report), computed);
  if (report.witness.violated > 0 && !ending.law_violated)
    report.warnings.push_back(sentence_of(report.witness, computed));
  const double rounding = ending.energy_rounding * factor_of(unit::energy, computed.unit);
  if (const auto sentence = energy_lost(report.audit, report.method, rounding, exact_takes(computed, spec)))
    report.warnings.push_back(*sentence);
  return report;
}

Report simulated(const Model& model, const RunSpec& settings, Recorder& recorder, RunHooks hooks) {
  const EngineChoice choice = choose_engine(model, settings);
  RunSpec spec = settings;
  spec.engine = choice.engine;
  const EngineRow& engine = engine_row(spec.engine);
  engine.refuse(model, spec);
  Method method = engine.method(model, spec);
  method.automatic = choice.automatic;
  method.reason = choice.reason;
  const Factors to_machine = inverse(model.machine);
  Model computed = rescaled(model, to_machine);
  spec = rescaled(std::move(spec), to_machine);
  PhysicalRecorder in_scene(computed, recorder);
  hooks.rounds = physical(hooks.rounds, computed);
  const auto clock = std::chrono::steady_clock::now();
  std::vector<PartModel> parts = parts_to_run(computed, method, recorder, hooks);
  RunEnd ending = parts.empty()
                      ? run_whole(computed, spec, engine, std::move(method), in_scene, std::move(hooks))
                      : run_apart(computed, std::move(parts), spec, engine, std::move(method), in_scene);
  Report report = concluded(std::move(ending), computed, spec);
  report.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
  return report;
}

}  // namespace

Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder,
                const RoundListener& listener) {
  RunHooks hooks;
  hooks.rounds = listener;
  return simulated(model, settings, recorder, std::move(hooks));
}

Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder, RunListener& listener,
                const ListenerNeeds& needs, EventShift* event_shift) {
  RunHooks hooks;
  hooks.listeners.add(listener);
  hooks.needs = needs;
  hooks.event_shift = event_shift;
  return simulated(model, settings, recorder, std::move(hooks));
}

Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder, FaultInjector& faults) {
  RunHooks hooks;
  hooks.faults = &faults;
  return simulated(model, settings, recorder, std::move(hooks));
}

Result simulate(const Model& model, const RunSpec& settings) {
  Result result;
  result.report = simulate(model, settings, result);
  return result;
}

Report simulate(const Scene& scene, Recorder& recorder) {
  return simulate(build_model(scene), scene.run, recorder);
}

Result simulate(const Scene& scene) { return simulate(build_model(scene), scene.run); }

}  // namespace signorini
