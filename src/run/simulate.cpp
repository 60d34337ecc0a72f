// From a model to its report: in the units of the machine, and back.
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
  return simulate(model, settings, recorder, {});
}

namespace {

Ending run_whole(Model& model, const RunSpec& spec, const EngineRow& engine, Method method,
                 Recorder& recorder, const Company& company) {
  Loop loop(model, spec, engine, std::move(method), recorder, company);
  loop.begin();
  loop.on(spec.t_end);
  return loop.end();
}

/// In the units of the scene, with what is said of a run when it is over.
Report concluded(Ending ending, const Model& computed, const RunSpec& spec) {
  Report report = physical(std::move(ending.report), computed);
  if (report.witness.violated > 0 && !ending.grave)
    report.warnings.push_back(sentence_of(report.witness, computed));
  const double rounding = ending.energy_rounding * factor_of(unit::energy, computed.unit);
  if (const auto sentence = energy_lost(report.audit, report.method, rounding, exact_takes(computed, spec)))
    report.warnings.push_back(*sentence);
  return report;
}

Report simulated(const Model& model, const RunSpec& settings, Recorder& recorder, const Company& company) {
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
  const RoundListener listener = physical(company.listener, computed);
  const auto clock = std::chrono::steady_clock::now();
  std::vector<PartModel> parts = parts_to_run(computed, spec, method, recorder, company);
  Ending ending = parts.empty()
                      ? run_whole(computed, spec, engine, std::move(method), in_scene,
                                  {listener, company.observer, company.meddler})
                      : run_apart(computed, std::move(parts), spec, engine, std::move(method), in_scene);
  Report report = concluded(std::move(ending), computed, spec);
  report.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
  return report;
}

}  // namespace

Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder,
                const RoundListener& listener) {
  return simulated(model, settings, recorder, {listener});
}

Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder, MotionObserver& observer) {
  return simulated(model, settings, recorder, {{}, &observer});
}

Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder, Meddler& meddler) {
  return simulated(model, settings, recorder, {{}, nullptr, &meddler});
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
