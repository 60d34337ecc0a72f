#include "certify/companion.hpp"

#include <fmt/core.h>
#include <algorithm>

#include "certify/data_perturbation.hpp"
#include "engine/tolerance.hpp"
#include "model/slip_growth.hpp"
#include "run/cost_estimate.hpp"
#include "run/engines.hpp"
#include "signorini/error.hpp"

namespace signorini::certify {
namespace {

// Factors c and fractions of t_uncertainty; reasons: companion.hpp.
constexpr double by_exact = 1.5, by_tolerance = 2.0, by_step = 3.0, by_rounding = 5.0;
constexpr double local_beside_exact = 0.1, local_beside_finer = 0.5;
constexpr double finer_tolerance = 0.01, finer_step = 0.5;
constexpr double rtol_beside_steps = 1e-9;  // gives far smaller errors than fixed steps; chosen value
// Limit of z = dt * (fastest rate of a motion). For decays, the amplification (1 - z/2) / (1 + z/2) of average acceleration
// becomes negative at z = 2; for a frequency z/dt, the relative period error is z^2/12.
constexpr double resolved = 1.0;

/// Model and settings that all companions have in common.
CompanionRun companion_of(const Model& model, const RunSpec& run) {
  CompanionRun companion{model, run};
  set_capture_velocities(companion.model, engine::tolerance_of(model, run).capture_velocity());
  companion.run.frames.clear();
  companion.model.outputs.clear();  // outputs are not compared
  return companion;
}

CompanionPlan exact_plan(const Model& model, const RunSpec& run) {
  CompanionPlan plan;
  const Engine closed_form = run::engine_for(run::EngineRole::closed_form);
  plan.name = to_string(closed_form);
  plan.factor = by_exact;
  if (engine_info(run.engine).accuracy == Accuracy::tolerance) plan.local = local_beside_exact;
  plan.runs.push_back(companion_of(model, run));
  plan.runs.back().run.engine = closed_form;
  return plan;
}

CompanionPlan ida_plan(const Model& model, const RunSpec& run) {
  CompanionPlan plan;
  plan.factor = by_exact;
  plan.runs.push_back(companion_of(model, run));
  RunSpec& own = plan.runs.back().run;
  own.engine = run::engine_for(run::EngineRole::integrator);
  own.rtol = std::min(own.rtol, rtol_beside_steps);
  own.atol = {};
  plan.name = fmt::format("{}, rtol {:g}", to_string(own.engine), own.rtol);
  return plan;
}

/// Reason why a run with dt / 2 cannot estimate the error of the run with dt; empty: it can.
std::string unresolved(const Model& model, double dt) {
  const double decay = model::fastest_decay(model), rate = std::max(model.omega_max, decay);
  if (dt * rate <= resolved) return "";
  return fmt::format(
      "dt = {:g} {} does not resolve the fastest {}, {:.3g} {}/{}, so a run with dt / 2 may have the "
      "same error; use companion = \"exact\", or a dt of {:.2g}",
      dt, model.units.time, decay > model.omega_max ? "decay" : "oscillation", rate,
      decay > model.omega_max ? "1" : "rad", model.units.time, resolved / rate);
}

/// Refines the absolute tolerances that the scene gives. Default tolerances are multiples of rtol, so they change with it.
void make_finer(Tolerances& atol) {
  for (std::optional<double>* t : {&atol.displacement, &atol.velocity, &atol.force})
    if (*t) **t *= finer_tolerance;
}

CompanionPlan finer_plan(const Model& model, const RunSpec& run) {
  CompanionPlan plan;
  CompanionRun companion = companion_of(model, run);
  const EngineInfo& engine = engine_info(run.engine);
  switch (engine.accuracy) {
    case Accuracy::rounding:
      plan.factor = by_rounding;
      plan.name = fmt::format("{}, twice, with all data changed by about one rounding", engine.name);
      for (const std::uint64_t seed : {1U, 2U})
        plan.runs.push_back({perturbed(companion.model, seed), companion.run, seed, 1.0 / by_rounding});
      return plan;
    case Accuracy::tolerance:
      plan.factor = by_tolerance;
      plan.local = local_beside_finer;
      companion.run.rtol *= finer_tolerance;
      companion.run.flight_tolerances /= finer_tolerance;
      make_finer(companion.run.atol);
      plan.name = fmt::format("{}, rtol {:g}", engine.name, companion.run.rtol);
      break;
    case Accuracy::step:
      plan.factor = by_step;
      companion.run.dt = finer_step * companion.run.dt.value_or(0.0);
      plan.name = fmt::format("{}, dt {:g}", engine.name, *companion.run.dt);
      plan.limitation = unresolved(model, run.dt.value_or(0.0));
      break;
  }
  plan.runs.push_back(std::move(companion));
  return plan;
}

void estimate(CompanionPlan& plan, const Model& model, const RunSpec& run) {
  const run::CostEstimate own = run::expected_cost(model, run).estimate;
  plan.engine = plan.runs.front().run.engine;
  plan.run_seconds = own.seconds;
  plan.run_steps = own.steps;
  for (const CompanionRun& companion : plan.runs) {
    const run::CostEstimate effort = run::expected_cost(companion.model, companion.run).estimate;
    plan.steps = effort.steps;
    if (!(own.seconds > 0.0) || !(effort.seconds > 0.0)) {
      plan.cost = plan.seconds = 0.0;
      return;
    }
    plan.cost += effort.seconds / own.seconds;
    plan.seconds += effort.seconds;
  }
}

}  // namespace

void set_capture_velocities(Model& model, double capture_velocity) {
  for (Contact& contact : model.contacts)
    if (!contact.capture_velocity) contact.capture_velocity = capture_velocity;
}

CompanionPlan plan_companion(const Model& model, const RunSpec& run) {
  const bool itself = run::engine_row(run.engine).role == run::EngineRole::closed_form;
  if (run.companion == Companion::exact && !itself && !run::exact_accepts(model, run))
    throw SceneError(
        run.place, "run.companion",
        "\"exact\" cannot compute this scene (signorini check --engine exact shows why); use \"finer\"");
  const bool steps = engine_info(run.engine).accuracy == Accuracy::step;
  const bool may_be_exact = !itself && run.companion != Companion::finer && run::exact_accepts(model, run);
  if (steps && run.companion == Companion::automatic) {
    CompanionPlan plan = may_be_exact ? exact_plan(model, run) : ida_plan(model, run);
    estimate(plan, model, run);
    plan.choice = fmt::format("auto: a run with half the step may have the same error{}",
                              may_be_exact ? "" : ", and exact cannot compute the scene");
    return plan;
  }
  const bool may_be_finer = itself || run.companion != Companion::exact;
  std::optional<CompanionPlan> exact, finer;
  if (may_be_exact) estimate(exact.emplace(exact_plan(model, run)), model, run);
  if (may_be_finer && !(exact && run.companion == Companion::exact))
    estimate(finer.emplace(finer_plan(model, run)), model, run);
  if (!exact || !finer) {
    CompanionPlan plan = std::move(exact ? *exact : *finer);
    plan.choice = run.companion != Companion::automatic ? "as given"
                  : itself                              ? "auto: the run itself uses exact"
                                                        : "auto: exact cannot compute the scene";
    return plan;
  }
  // If a cost is unknown, exact is used, because its error bounds are smaller.
  const bool cheaper = !(finer->cost > 0.0) || !(exact->cost > 0.0) || exact->cost <= finer->cost;
  CompanionPlan plan = std::move(cheaper ? *exact : *finer);
  plan.choice = cheaper ? "auto: exact is cheaper" : "auto: a finer run is expected to be cheaper than exact";
  return plan;
}

void CompanionTracker::event(const Event& event) {
  events.push_back(timed_event(event));
  events.back().t -= event_shift * events.back().t;
  run::ForwardingRecorder::event(event);
}

void CompanionTracker::sample(const Sample& sample) {
  rows.t.push_back(sample.t);
  for (const Column& column : model_.columns) {
    rows.values.push_back(column.value(*sample.u, *sample.v));
  }
  if (all_) {
    for (const ContactSample& contact : sample.contacts)
      rows.values.insert(rows.values.end(), {contact.N, contact.T});
    // For the same time, response() is called after sample(); at an event, response() is called first.
    if (last_time_ == sample.t)
      rows.values.insert(rows.values.end(), last_outputs_.begin(), last_outputs_.end());
    else
      rows.values.resize(rows.t.size() * rows.width, std::numeric_limits<double>::quiet_NaN());
  }
  run::ForwardingRecorder::sample(sample);
}

void CompanionTracker::response(double t, const std::vector<double>& values) {
  if (all_ && values.size() == model_.outputs.size()) {
    last_time_ = t;
    last_outputs_ = values;
    if (!rows.t.empty() && rows.t.back() == t)
      std::copy(values.begin(), values.end(), rows.values.end() - static_cast<std::ptrdiff_t>(values.size()));
  }
  run::ForwardingRecorder::response(t, values);
}

bool CompanionTracker::progress(double t) {
  if (!companion_) return run::ForwardingRecorder::progress(t);
  too_long = ++steps_ > max_steps;
  return !too_long && (limit == nullptr || limit->allows(t));
}

}  // namespace signorini::certify
