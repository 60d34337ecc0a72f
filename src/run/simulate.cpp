// Runs a model in the units of the computation, and reports its results in the units of the scene.

#include "signorini/simulate.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "model/assembly/loads.hpp"
#include "model/internal_units.hpp"
#include "run/choose_engine.hpp"
#include "run/cost_estimate.hpp"
#include "run/independent_parts.hpp"
#include "run/loop.hpp"
#include "run/scene_units.hpp"
#include "run/warnings.hpp"
#include "scene/quantities.hpp"
#include "scene/saved_state.hpp"

namespace signorini {

Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder) {
  return simulate(model, settings, recorder, RoundListener());
}

}  // namespace signorini

namespace signorini::run {

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
  Report report = to_scene_units(std::move(ending.report), computed);
  if (report.law_checks.violated > 0 && !ending.law_violated)
    report.warnings.push_back(sentence_of(report.law_checks, computed));
  const double rounding = ending.energy_rounding * scene::factor_of(unit::energy, computed.unit);
  if (const auto sentence =
          energy_warning(report.audit, report.method, rounding, exact_accepts(computed, spec)))
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
  const Factors to_machine = scene::inverse(model.internal_units);
  Model computed = model::rescaled(model, to_machine);
  spec = scene::rescaled(std::move(spec), to_machine);
  SceneUnitsRecorder in_scene(computed, recorder);
  hooks.rounds = to_scene_units(hooks.rounds, computed);
  const auto clock = std::chrono::steady_clock::now();
  std::vector<assembly::PartModel> parts = parts_to_run(computed, method, recorder, hooks);
  RunEnd ending =
      parts.empty()
          ? run_whole(computed, spec, engine, std::move(method), in_scene, std::move(hooks))
          : run_independent_parts(computed, std::move(parts), spec, engine, std::move(method), in_scene);
  Report report = concluded(std::move(ending), computed, spec);
  report.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
  return report;
}

}  // namespace

}  // namespace signorini::run

namespace signorini {

Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder,
                const RoundListener& listener) {
  run::RunHooks hooks;
  hooks.rounds = listener;
  return run::simulated(model, settings, recorder, std::move(hooks));
}

}  // namespace signorini

namespace signorini::run {

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

}  // namespace signorini::run

namespace signorini {

Result simulate(const Model& model, const RunSpec& settings) {
  Result result;
  result.report = simulate(model, settings, result);
  return result;
}

Report simulate(const Scene& scene, Recorder& recorder) {
  return simulate(build_model(scene), scene.run, recorder);
}

Result simulate(const Scene& scene) { return simulate(build_model(scene), scene.run); }

SavedState last_state(const Model& model, const Result& result) {
  if (result.rows.empty()) throw std::invalid_argument("last_state: the run has no row");
  const Result::Row& last = result.rows.back();
  SavedState state;
  const std::vector<Dof>& dofs = model.physical_dofs();
  // Sliding points are the last degrees of freedom; the state file has them as "CONTACT.slip", not as displacements.
  const auto sliding = std::count_if(model.contacts.begin(), model.contacts.end(),
                                     [](const Contact& c) { return c.sliding_point() != nullptr; });
  const std::size_t structural = dofs.size() - (model.reduction ? 0 : static_cast<std::size_t>(sliding));
  for (std::size_t i = 0; i < structural; ++i) {
    state.motions.emplace_back(dofs[i].displacement, last.u[static_cast<Eigen::Index>(i)]);
    state.motions.emplace_back(dofs[i].velocity, last.v[static_cast<Eigen::Index>(i)]);
  }
  for (const Load& load : model.loads)
    if (load.kind == LoadKind::support) {
      const Piece& motion = load.history.piece(last.t);
      state.motions.emplace_back(load.name, motion.value(last.t));
      state.motions.emplace_back(assembly::rate_of(load.name), motion.value(last.t, 1));
    }
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const ContactSample& contact = last.contacts[k];
    const History& surface = model.contacts[k].surface_motion;
    if (model.contacts[k].sliding_point())
      state.motions.emplace_back(model.contacts[k].name + ".slip", contact.slip + surface.value(last.t));
    if (!surface.is_constant())
      state.motions.emplace_back(model.contacts[k].name + ".surface", surface.value(last.t));
    if (!model.contacts[k].obeys_coulomb())
      state.user_law_states.push_back(
          {model.contacts[k].name, user_law_state_number(contact.state), contact.memory});
    if (!model.contacts[k].has_friction()) continue;
    state.shears.emplace_back(model.contacts[k].name, last.contacts[k].T);
    state.slips.emplace_back(model.contacts[k].name, slip_sign(last.contacts[k].state));
  }
  const Scales& s = model.scales;
  state.scales = {s.displacement, s.rotation, s.velocity, s.angular_velocity, s.force};
  state.motions.emplace_back(scene::saved_alpha, model.alpha);
  for (const Contact& contact : model.contacts)
    if (const CurvedSurface* surface = contact.curved_surface())
      state.pendulum_forces.emplace_back(contact.name, surface->nominal_force);
  if (model.geometric) state.prestress = model.geometric->forces;
  return state;
}

}  // namespace signorini
