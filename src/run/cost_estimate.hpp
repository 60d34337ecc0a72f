// cost_estimate.hpp: estimated cost of a run, and of engine exact in its place: by rules, or by trials of a
// few steps.
//
// Loads that vary faster than the structure are included.
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
//   modes         a step follows the excited modes: 0.002 n^2 steps of the series; plus modes of 16 states
//   BDF, order 5  max(12, 3.1 rtol^(-1/6)) steps in the shortest period
//   fixed steps   t_end / dt

/// Zero steps: the cost is unknown beforehand.
struct CostEstimate {
  double steps_per_period = 0.0;  ///< of omega_max
  double steps = 0.0, seconds = 0.0;
  double first = 0.0;  ///< part of `seconds` before the first step has ended: modes of a state
  double by_series = 0.0,
         by_modes = 0.0;  ///< exact: seconds with each flow; 0: modes cannot compute the scene
};

struct CostInputs {
  const Model& model;
  const RunSpec& run;
  const Method& method;
  double omega_max;  ///< > 0; of the structure with all contacts sticking, and of harmonic loads
  long unknowns;
};

/// Costs by the rules above, for the engine exact, for BDF, and for fixed steps.
[[nodiscard]] CostEstimate cost_of_exact(const CostInputs& parts);
[[nodiscard]] CostEstimate cost_of_bdf(const CostInputs& parts);
[[nodiscard]] CostEstimate cost_of_fixed_steps(const CostInputs& parts);

/// Seconds of the whole run with the series; and for the complex modes of all states that contacts may enter.
[[nodiscard]] double seconds_of_series(const Model& model, const RunSpec& run);
[[nodiscard]] double seconds_of_damped_states(const Model& model);
/// Seconds that an event takes in `exact` with its series: the decision, and the restart of the series.
[[nodiscard]] double seconds_of_event(const Model& model);

// Estimates the duration of a run from its first steps.
//
//   seconds = s + (t_end - t) (s - s_1) / (t - t_1)       s: wall time when t is reached
// (t, s) is the end of the trial, or of the run. (t_1, s_1) is reached after a quarter of the trial's time,
// so that assembly, factorisation and the small steps of a start are counted once. The estimate holds if the
// motion continues as it begins: it is too short if the structure is at rest before a load acts, or if events
// come later. If t - t_1 is less than ten estimated steps, as on a busy machine after a start at friction
// limits, CostEstimate::seconds is used.

struct Trial {
  Engine engine = Engine::automatic;
  double cutoff = 0.0;   ///< of [reduction], as a frequency; 0: the model without reduction
  double seconds = 0.0;  ///< for the whole run
};

/// Wall time, in seconds since the start, at which a time of the run was reached.
struct TrialTime {
  double t = 0.0, seconds = 0.0;
};

/// The equation above for early = (t_1, s_1) and late = (t, s); proportional to t if they are equal; 0 if t
/// is 0.
[[nodiscard]] double extrapolated_seconds(double t_end, const TrialTime& early, const TrialTime& late);

/// Expected seconds of the run with this engine; 0 if the engine does not accept the scene or stops within
/// the trial. seconds_limit: limit for the trial. If the first step is expected to take too long, no trial is
/// run and CostEstimate::seconds is returned.
[[nodiscard]] double seconds_by_trial(const Model& model, RunSpec run, Engine engine, double seconds_limit);

/// Trials of exact, ida and the run's own engine, each with `model` and with each cutoff. A scene that has a
/// [reduction] already is tried without other cutoffs.
[[nodiscard]] std::vector<Trial> trials(const Scene& scene, const Model& model, Engine own,
                                        const std::vector<double>& cutoffs, double seconds_limit);

/// Cutoff worth a trial: 50 times the lowest frequency, if that is far below the highest; otherwise 0. Chosen value;
/// `[reduction] tolerance` finds its accuracy.
[[nodiscard]] double cutoff_to_try(double lowest_omega, double highest_omega);

/// Trials as text: "exact 36 s, ida 5 s; with [reduction] cutoff_frequency = 100: exact 1.5 s".
[[nodiscard]] std::string trial_text(const std::vector<Trial>& trials);

/// Recommendation if `own` is expected to take `seconds`, more than four times another trial and more than five
/// seconds; otherwise empty.
[[nodiscard]] std::string faster_engine_advice(const std::vector<Trial>& trials, Engine own, double seconds);

struct ExpectedCost {
  long unknowns = 0;
  double omega_max = 0.0;  ///< of the structure with all contacts sticking, and of harmonic loads
  CostEstimate estimate;
};

/// Cost of the run with run.engine, which must not be automatic, and its `method`.
[[nodiscard]] ExpectedCost expected_cost(const Model& model, const RunSpec& run, const Method& method);
/// Cost with the engine's own method. Errors: SceneError if a step is required and not given.
[[nodiscard]] ExpectedCost expected_cost(const Model& model, const RunSpec& run);

/// True if engine `exact` accepts this model and may be chosen automatically. Laws made of data run in its
/// series only if a scene names this engine.
[[nodiscard]] bool exact_accepts(const Model& model, const RunSpec& run);

/// Seconds with exact instead of ida; nullopt: another engine, a scene that exact does not accept, or an unknown cost.
[[nodiscard]] std::optional<double> seconds_with_exact(const Model& model, const RunSpec& run);

/// Duration as text: "about 3", "less than 0.1".
[[nodiscard]] std::string seconds_text(double seconds);

}  // namespace signorini::run
