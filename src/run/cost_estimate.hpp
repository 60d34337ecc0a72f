// cost_estimate.hpp: estimated cost of a run, and of the same run with engine exact: by rules, or by trials of a few
// steps.
//
// The highest frequency in these rules includes the frequencies of loads.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signorini/model.hpp"
#include "signorini/result.hpp"
#include "signorini/scene.hpp"

namespace signorini::run {

// Estimated cost of a time loop, as an order of magnitude, before it runs.
//
//   series        t_end * max(omega_max, fastest decay) / 5.3 steps
//   modes         one step replaces 0.002 n^2 steps of the series (n unknowns); plus the modes of at most 16 states
//   BDF, order 5  max(12, 3.1 rtol^(-1/6)) steps in the shortest period
//   fixed steps   t_end / dt

/// Estimated cost of a run. steps = 0: the cost cannot be estimated.
struct CostEstimate {
  double steps_per_period = 0.0;  ///< period 2 pi / omega_max
  double steps = 0.0, seconds = 0.0;
  double first = 0.0;  ///< part of `seconds` before the first step ends: the modes of contact states
  /// Engine exact: seconds with each flow; 0: this flow cannot compute the scene.
  double by_series = 0.0, by_modes = 0.0;
};

struct CostInputs {
  const Model& model;
  const RunSpec& run;
  const Method& method;
  double
      omega_max;  ///< highest frequency, > 0, of the structure with all contacts sticking and of harmonic loads
  long unknowns;
};

/// Costs by the rules above for engine exact, for BDF, and for fixed steps.
[[nodiscard]] CostEstimate cost_of_exact(const CostInputs& parts);
[[nodiscard]] CostEstimate cost_of_bdf(const CostInputs& parts);
[[nodiscard]] CostEstimate cost_of_fixed_steps(const CostInputs& parts);

/// Seconds of the whole run with the series, and seconds to compute the complex modes of all likely contact states.
[[nodiscard]] double seconds_of_series(const Model& model, const RunSpec& run);
[[nodiscard]] double seconds_of_damped_states(const Model& model);
/// Seconds per event in engine exact with series: the decision of contact states, and the restart of the series.
[[nodiscard]] double seconds_of_event(const Model& model);

// Estimates the duration of a run from its first steps.
//
//   seconds = s + (t_end - t) (s - s_1) / (t - t_1)       s: wall time when t is reached
//
// The trial, or the run, ends at (t, s). The point (t_1, s_1) is reached after a quarter of the trial's wall time, so that
// assembly, factorisation and the small steps at the start are not extrapolated. The estimate is too small if the motion
// becomes more expensive later, for example if loads or events start late. If t - t_1 is shorter than ten estimated
// steps, CostEstimate::seconds is used instead.

struct Trial {
  Engine engine = Engine::automatic;
  double cutoff = 0.0;   ///< cutoff_frequency of [reduction]; 0: the model without reduction
  double seconds = 0.0;  ///< expected duration of the whole run
};

/// Time t of the run, and the wall time at which the run reached t, in seconds since its start.
struct TrialTime {
  double t = 0.0, seconds = 0.0;
};

/// Seconds by the equation above for early = (t_1, s_1) and late = (t, s). If t = t_1: s t_end / t; if t = 0: 0.
[[nodiscard]] double extrapolated_seconds(double t_end, const TrialTime& early, const TrialTime& late);

/// Expected seconds of the run with this engine; 0 if the engine does not accept the scene or stops within the trial.
/// seconds_limit: wall time of the trial. If the first step is expected to take more than 2 s, no trial is made and
/// CostEstimate::seconds is returned.
[[nodiscard]] double seconds_by_trial(const Model& model, RunSpec run, Engine engine, double seconds_limit);

/// Trials of exact, ida and the engine `own` of the run, each with `model` and with each cutoff. If the scene has a
/// [reduction] already, no other cutoffs are tried.
[[nodiscard]] std::vector<Trial> trials(const Scene& scene, const Model& model, Engine own,
                                        const std::vector<double>& cutoffs, double seconds_limit);

/// Cutoff frequency for a trial: 50 times the lowest frequency (chosen), rounded to one digit; 0 if the highest frequency
/// is less than 4 times this value. `[reduction] tolerance` estimates the accuracy of a cutoff.
[[nodiscard]] double cutoff_to_try(double lowest_omega, double highest_omega);

/// Trials as text: "exact 36 s, ida 5 s; with [reduction] cutoff_frequency = 100: exact 1.5 s".
[[nodiscard]] std::string trial_text(const std::vector<Trial>& trials);

/// Recommendation if the run with engine `own` is expected to take `seconds`, and this is more than 5 s and more than four
/// times the fastest trial; otherwise empty.
[[nodiscard]] std::string faster_engine_advice(const std::vector<Trial>& trials, Engine own, double seconds);

struct ExpectedCost {
  long unknowns = 0;
  /// Highest frequency of the structure with all contacts sticking and of harmonic loads.
  double omega_max = 0.0;
  CostEstimate estimate;
};

/// Cost of the run with run.engine, which must not be automatic, and its `method`.
[[nodiscard]] ExpectedCost expected_cost(const Model& model, const RunSpec& run, const Method& method);
/// Cost with the default method of run.engine. Errors: SceneError if the engine requires run.dt and the scene has none.
[[nodiscard]] ExpectedCost expected_cost(const Model& model, const RunSpec& run);

/// True if engine `exact` accepts this model and may be chosen automatically. A scene with contact laws other than Coulomb
/// friction runs with `exact` only if the scene names this engine.
[[nodiscard]] bool exact_accepts(const Model& model, const RunSpec& run);

/// Expected seconds of a run with ida if it used exact; nullopt: the run does not use ida, exact does not accept the scene,
/// or the cost is unknown.
[[nodiscard]] std::optional<double> seconds_with_exact(const Model& model, const RunSpec& run);

/// Duration as text: "about 3", "less than 0.1".
[[nodiscard]] std::string seconds_text(double seconds);

}  // namespace signorini::run
