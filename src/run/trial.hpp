// trial.hpp: estimates the duration of a run from its first steps.
//
//   seconds = s + (t_end - t) (s - s_1) / (t - t_1)       s: wall time when t is reached
//
// (t, s) is the end of the trial, or of the run; (t_1, s_1) is a quarter of the trial's time, so that assembly,
// factorisation and the small steps of a start are counted once. The estimate holds if the motion continues as it
// begins: a rest before a load acts makes it too short, and so do later events. If t - t_1 is less than ten steps by
// the rule of effort.hpp, as on a busy machine after a start at the limits of friction, the seconds of the rule are
// used.
#pragma once

#include <string>
#include <vector>

#include "signorini/result.hpp"
#include "signorini/scene.hpp"

namespace signorini {

struct Trial {
  Engine engine = Engine::automatic;
  double cutoff = 0.0;   ///< of [reduction], as a frequency; 0: the model without reduction
  double seconds = 0.0;  ///< for the whole run
};

/// Wall time, in seconds since the start, at which a time of the run was reached.
struct TrialTime {
  double t = 0.0, seconds = 0.0;
};

/// The equation above for (t_1, s_1) and (t, s); proportional to t if they are equal; 0 if t is 0.
[[nodiscard]] double seconds_of_all(double t_end, const TrialTime& early, const TrialTime& late);

/// Expected seconds of the run with this engine; 0: it does not accept the scene, or stops within the trial.
/// `patience`: limit for the seconds of the trial, and for a step; the rule of effort.hpp is used if the first one
/// takes too long.
[[nodiscard]] double seconds_by_trial(const Model& model, RunSpec run, Engine engine, double patience);

/// Trials of exact, ida and the run's own engine, each without reduction and with each cutoff. `model`: of the scene
/// without [reduction]; a scene that has one is tried without other cutoffs.
[[nodiscard]] std::vector<Trial> trials(const Scene& scene, const Model& model, Engine own,
                                        const std::vector<double>& cutoffs, double patience);

/// Cutoff worth a trial: 50 times the lowest frequency, if that is far below the highest; otherwise 0. Chosen value;
/// `[reduction] tolerance` finds its accuracy.
[[nodiscard]] double cutoff_to_try(double lowest_omega, double highest_omega);

/// Trials as text: "exact 36 s, ida 5 s; with [reduction] cutoff_frequency = 100: exact 1.5 s".
[[nodiscard]] std::string trial_text(const std::vector<Trial>& trials);

/// Recommendation if `own` is expected to take `seconds`, more than four times another trial and more than five
/// seconds; otherwise empty.
[[nodiscard]] std::string quicker(const std::vector<Trial>& trials, Engine own, double seconds);

}  // namespace signorini
