// trial.hpp: how long a run takes, from what its first steps took.
//
//   seconds = s + (t_end - t) (s - s_1) / (t - t_1)       s: wall time when t is reached
//
// t, s: where the trial's time is over, or the run's end; t_1, s_1: after a quarter of the trial's time, so that
// assembling, factors and the small steps of a start are counted once. It is that of the whole run as far as the motion goes
// on as it begins: a rest before a load acts makes it too short, events that come later too. Where t - t_1 is less than ten steps
// of the rule of effort.hpp, as on a busy machine after a start at the limits of friction, the rule's seconds stand.
#pragma once

#include <string>
#include <vector>

#include "signorini/result.hpp"
#include "signorini/scene.hpp"

namespace signorini {

struct Trial {
  Engine engine = Engine::automatic;
  double cutoff = 0.0;   ///< of [reduction], as a frequency; 0: the model as it is
  double seconds = 0.0;  ///< of the whole run
};

/// When a time of the run was reached, in seconds since it began.
struct TrialTime {
  double t = 0.0, seconds = 0.0;
};

/// The equation above, from (t_1, s_1) and (t, s); in proportion to t where they are one; 0 where t is 0.
[[nodiscard]] double seconds_of_all(double t_end, const TrialTime& early, const TrialTime& late);

/// Seconds that the run is expected to take by this engine; 0 where it does not take the scene, or stops within the trial.
/// `patience`: seconds that the trial may take, and a step; by the rule of effort.hpp where the first one takes too long.
[[nodiscard]] double seconds_by_trial(const Model& model, RunSpec run, Engine engine, double patience);

/// exact and ida, and the run's own engine where it is another; each as it is and with each cutoff. `whole`: of the scene
/// without [reduction]; a scene that has one is tried as it is only.
[[nodiscard]] std::vector<Trial> trials(const Scene& scene, const Model& model, Engine own,
                                        const std::vector<double>& cutoffs, double patience);

/// A cutoff that is worth a trial: 50 times the lowest frequency, if that is far below the highest; else 0. Chosen; how good
/// it is `[reduction] tolerance` finds out.
[[nodiscard]] double cutoff_to_try(double lowest_omega, double highest_omega);

/// "exact 36 s, ida 5 s; with [reduction] cutoff_frequency = 100: exact 1.5 s"
[[nodiscard]] std::string trial_text(const std::vector<Trial>& trials);

/// Where `own` is expected to take `seconds`, more than four times another of them and more than five seconds: a sentence that
/// says so. Else empty.
[[nodiscard]] std::string quicker(const std::vector<Trial>& trials, Engine own, double seconds);

}  // namespace signorini
