#include "run/cost_estimate.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "model/slip_growth.hpp"
#include "run/choose_engine.hpp"
#include "run/engines.hpp"
#include "signorini/error.hpp"
#include "signorini/simulate.hpp"

namespace signorini::run {
namespace {

/// Seconds per step: own + unknown * (number of unknowns). Measured on a machine of 2024, one thread.
struct StepTime {
  double own, unknown;
};

// Measured with order 5 on models/pipeline.toml and tests/cases/07: 12, 29, 67, 144 steps in the shortest period at
// rtol 1e-4, 1e-6, 1e-8, 1e-10. The step is limited by accuracy, h ~ rtol^(1/6), and by stability.
constexpr double steps_at_stability = 12.0, steps_at_unit_tolerance = 3.1;
constexpr StepTime time_of_bdf = {1e-6, 2e-8};
// Measured on models/pipeline.toml with three meshes: omega_max h of a step h, in rad.
constexpr double radians_of_series = 5.3;
constexpr StepTime time_of_series = {4e-6, 3.5e-7};
// Measured on beams with 100, 300 and 1000 contacts, 3 unknowns per contact: 0.5, 1.8, 4.2 ms per event.
constexpr StepTime time_of_event = {1e-5, 1.5e-6};
// Measured on models/pipeline.toml and a single mass.
constexpr StepTime time_of_fixed_steps = {3e-7, 1.6e-8};

// Measured on models/pipeline.toml, run of 1.2 s. Real modes at 51, 201 and 801 unknowns: 0.04, 0.38 and 4.4 s. Complex
// modes of one state at 51 and 99 unknowns: 6 and 45 ms.
constexpr double gain_of_modes = 2e-3, time_of_modes = 4e-5, order_of_modes = 1.7;
constexpr double usual_states = 16.0, time_of_damped_state = 4.5e-8;
constexpr StepTime time_of_proof = {1e-5, 1e-7}, time_of_damped_proof = {3e-5, 1e-6};

CostEstimate effort(double steps_per_period, double steps, const StepTime& time, long unknowns) {
  return {steps_per_period, steps, steps * (time.own + time.unknown * static_cast<double>(unknowns))};
}

CostEstimate effort_of_series(const Model& model, const RunSpec& run, double omega_max) {
  const double fastest = std::max(omega_max, model::fastest_decay(model));
  return effort(2.0 * std::numbers::pi / radians_of_series * fastest / omega_max,
                run.t_end * fastest / radians_of_series, time_of_series, model.size());
}

}  // namespace

double seconds_of_series(const Model& model, const RunSpec& run) {
  return model.omega_max > 0.0 ? effort_of_series(model, run, model.omega_max).seconds : 0.0;
}

double seconds_of_event(const Model& model) {
  return time_of_event.own + time_of_event.unknown * static_cast<double>(model.size());
}

double seconds_of_damped_states(const Model& model) {
  double states = 1.0;
  for (const Contact& contact : model.contacts)
    states = std::min(states * (contact.has_friction() ? 4.0 : 2.0), usual_states);
  return states * time_of_damped_state * std::pow(static_cast<double>(model.size()), 3.0);
}

CostEstimate cost_of_exact(const CostInputs& parts) {
  CostEstimate result = effort_of_series(parts.model, parts.run, parts.omega_max);
  result.by_series = result.seconds;
  const ModalKind kind = modal_kind(parts.model);
  if (kind.too_many_springs || !kind.objection.empty()) return result;
  const double n = parts.model.size(), gain = std::max(1.0, gain_of_modes * n * n);
  const StepTime& step = kind.damped ? time_of_damped_proof : time_of_proof;
  const double modes =
      kind.damped ? seconds_of_damped_states(parts.model) : time_of_modes * std::pow(n, order_of_modes);
  result.by_modes = modes + result.steps / gain * (step.own + step.unknown * n);
  if (parts.method.flow != "modal") return result;
  result.steps_per_period /= gain;
  result.steps /= gain;
  result.seconds = result.by_modes;
  result.first = modes;
  return result;
}

CostEstimate cost_of_bdf(const CostInputs& parts) {
  if (parts.method.max_order < 5) return {};
  const double steps_per_period =
      std::max(steps_at_stability, steps_at_unit_tolerance * std::pow(parts.run.rtol, -1.0 / 6.0));
  return effort(steps_per_period,
                steps_per_period * parts.run.t_end * parts.omega_max / (2.0 * std::numbers::pi), time_of_bdf,
                parts.unknowns);
}

CostEstimate cost_of_fixed_steps(const CostInputs& parts) {
  const double dt = parts.method.accuracy;
  return effort(2.0 * std::numbers::pi / (parts.omega_max * dt), parts.run.t_end / dt, time_of_fixed_steps,
                parts.unknowns);
}

namespace {

// Limit of the duration of the first step in s, because this step cannot be interrupted. Chosen value.
constexpr double max_first_effort_seconds = 2.0;
// Limits for a recommendation: least ratio of run times, and least duration of the run in s. Chosen values.
constexpr double min_time_ratio = 4.0, long_run = 5.0;

// Least progress of an extrapolated trial, in steps estimated by the rules. Chosen value.
constexpr double least_steps = 10.0;

/// Recorder that ends a run after a given wall time. It stores no rows, because a trial's memory is added to the run's.
class Stopwatch : public Recorder {
 public:
  explicit Stopwatch(double seconds_limit) : seconds_limit_(seconds_limit) {}
  void event(const Event& /*event*/) override {}
  void sample(const Sample& /*sample*/) override {}
  bool progress(double t) override {
    s = now();
    if (s < 0.25 * seconds_limit_ || t_1 == 0.0) {
      t_1 = t;
      s_1 = s;
    }
    t_reached = t;
    return s < seconds_limit_;
  }
  [[nodiscard]] double now() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  double s = 0.0, s_1 = 0.0, t_1 = 0.0, t_reached = 0.0;

 private:
  double seconds_limit_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::string about(double seconds) {
  if (seconds < 0.1) return "less than 0.1 s";
  return seconds < 9.5 ? fmt::format("{:.2g} s", seconds) : fmt::format("{:.0f} s", seconds);
}

}  // namespace

double extrapolated_seconds(double t_end, const TrialTime& early, const TrialTime& late) {
  const double moved = late.t - early.t;
  if (moved > 0.0) return late.seconds + (t_end - late.t) * (late.seconds - early.seconds) / moved;
  return late.t > 0.0 ? late.seconds * t_end / late.t : 0.0;
}

double seconds_by_trial(const Model& model, RunSpec run, Engine engine, double seconds_limit) {
  run.engine = engine;
  run.certify = Certify::no;
  try {
    // A trial can be stopped only after its first step: if this step takes long, no trial is started.
    const CostEstimate effort = expected_cost(model, run).estimate;
    if (effort.first > max_first_effort_seconds) return effort.seconds;
    Stopwatch watch(seconds_limit);
    const Report report = signorini::simulate(model, run, watch);
    if (report.outcome.kind == Outcome::Kind::done) return watch.now();
    if (report.outcome.kind != Outcome::Kind::interrupted) return 0.0;
    const double moved = watch.t_reached - watch.t_1;
    // A trial that has made only the small steps of the start is not extrapolated; the estimate by rules is returned.
    if (effort.steps > 0.0 && moved < least_steps * run.t_end / effort.steps) return effort.seconds;
    return extrapolated_seconds(run.t_end, {watch.t_1, watch.s_1}, {watch.t_reached, watch.s});
  } catch (const SceneError&) {
    return 0.0;
  }
}

std::vector<Trial> trials(const Scene& scene, const Model& model, Engine own,
                          const std::vector<double>& cutoffs, double seconds_limit) {
  std::vector<Engine> engines{engine_for(EngineRole::closed_form), engine_for(EngineRole::integrator)};
  if (std::find(engines.begin(), engines.end(), own) == engines.end()) engines.push_back(own);
  std::vector<Trial> list;
  const auto add = [&](const Model& tried, double cutoff) {
    for (const Engine engine : engines)
      if (const double seconds = seconds_by_trial(tried, scene.run, engine, seconds_limit); seconds > 0.0)
        list.push_back({engine, cutoff, seconds});
  };
  add(model, 0.0);
  if (scene.reduction) return list;
  for (const double cutoff : cutoffs) {
    Scene reduced = scene;
    reduced.reduction.emplace().cutoff_omega = 2.0 * std::numbers::pi * cutoff;
    try {
      add(build_model(reduced), cutoff);
    } catch (const SceneError&) {
      continue;  // the modes of the reduction cannot be computed
    }
  }
  return list;
}

double cutoff_to_try(double lowest_omega, double highest_omega) {
  constexpr double above = 50.0, below = 4.0;
  const double cutoff = above * lowest_omega / (2.0 * std::numbers::pi);
  if (!(cutoff > 0.0) || below * above * lowest_omega > highest_omega) return 0.0;
  const double unit = std::pow(10.0, std::floor(std::log10(cutoff)));
  return std::round(cutoff / unit) * unit;
}

std::string trial_text(const std::vector<Trial>& trials) {
  std::string text;
  double cutoff = 0.0;
  for (const Trial& trial : trials) {
    const bool other = trial.cutoff != cutoff;
    if (other)
      text +=
          fmt::format("{}with [reduction] cutoff_frequency = {:g}: ", text.empty() ? "" : "; ", trial.cutoff);
    else if (!text.empty())
      text += ", ";
    text += fmt::format("{} {}", to_string(trial.engine), about(trial.seconds));
    cutoff = trial.cutoff;
  }
  return text;
}

std::string faster_engine_advice(const std::vector<Trial>& trials, Engine own, double seconds) {
  const auto best = std::min_element(trials.begin(), trials.end(),
                                     [](const Trial& a, const Trial& b) { return a.seconds < b.seconds; });
  if (best == trials.end() || seconds < long_run || best->seconds * min_time_ratio > seconds) return "";
  return fmt::format("{} is expected to take {}; estimates from first steps of other settings: {}",
                     to_string(own), about(seconds), trial_text(trials));
}

namespace {

/// Rounds to one digit: estimates are orders of magnitude.
double rough(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)));
  return std::round(value / unit) * unit;
}

RunSpec by_exact(RunSpec run) {
  run.engine = engine_for(EngineRole::closed_form);
  return run;
}

}  // namespace

ExpectedCost expected_cost(const Model& model, const RunSpec& run, const Method& method) {
  ExpectedCost result;
  for (const Dof& dof : model.dofs) result.unknowns += dof.massless ? 1 : 2;
  result.unknowns += static_cast<long>(model.force_count());
  result.omega_max = model.omega_max;
  for (const Load& load : model.loads)
    for (const Piece& piece : load.history.pieces())
      if (piece.amplitude != 0.0) result.omega_max = std::max(result.omega_max, piece.omega);
  if (result.omega_max > 0.0)
    result.estimate =
        engine_row(method.engine).estimate_cost({model, run, method, result.omega_max, result.unknowns});
  return result;
}

ExpectedCost expected_cost(const Model& model, const RunSpec& run) {
  return expected_cost(model, run, engine_row(run.engine).method(model, run));
}

bool exact_accepts(const Model& model, const RunSpec& run) {
  if (!std::all_of(model.contacts.begin(), model.contacts.end(),
                   [](const Contact& contact) { return contact.has_linear_coulomb_law(); }))
    return false;
  try {
    const RunSpec exact = by_exact(run);
    engine_row(exact.engine).refuse(model, exact);
  } catch (const SceneError&) {
    return false;
  }
  return true;
}

std::optional<double> seconds_with_exact(const Model& model, const RunSpec& run) {
  if (engine_row(run.engine).role != EngineRole::integrator || !exact_accepts(model, run))
    return std::nullopt;
  const CostEstimate effort = expected_cost(model, by_exact(run)).estimate;
  return effort.seconds > 0.0 ? std::optional(effort.seconds) : std::nullopt;
}

std::string seconds_text(double seconds) {
  return seconds < 0.1 ? "less than 0.1" : fmt::format("about {:g}", rough(seconds));
}

}  // namespace signorini::run
