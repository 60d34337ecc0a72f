// effort.hpp: estimated cost of a time loop, as an order of magnitude, before it runs.
//
//   series        t_end * max(omega_max, fastest decay) / 5.3 steps
//   modes         a step follows the excited modes: 0.002 n^2 steps of the series; and the modes of about 16 states
//   BDF, order 5  max(12, 3.1 rtol^(-1/6)) steps in the shortest period
//   fixed steps   t_end / dt
#pragma once

#include "signorini/model.hpp"
#include "signorini/result.hpp"

namespace signorini {

/// Zero steps: the cost is unknown beforehand.
struct Effort {
  double steps_per_period = 0.0;  ///< of omega_max
  double steps = 0.0, seconds = 0.0;
  double first = 0.0;  ///< part of `seconds` before the first step has ended: modes of a state
  double by_series = 0.0,
         by_modes = 0.0;  ///< exact: seconds with each flow; 0: modes cannot compute the scene
};

struct EffortParts {
  const Model& model;
  const RunSpec& run;
  const Method& method;
  double omega_max;  ///< > 0; of the structure with all contacts sticking, and of harmonic loads
  long unknowns;
};

[[nodiscard]] Effort effort_of_exact(const EffortParts& parts);
[[nodiscard]] Effort effort_of_bdf(const EffortParts& parts);
[[nodiscard]] Effort effort_of_fixed_steps(const EffortParts& parts);

/// Duration of the whole run with the series; and of the complex modes of all states that its contacts may enter.
[[nodiscard]] double seconds_of_series(const Model& model, const RunSpec& run);
[[nodiscard]] double seconds_of_damped_states(const Model& model);
/// Duration of an event of `exact` with its series: the decision, and a series that restarts.
[[nodiscard]] double seconds_of_event(const Model& model);

}  // namespace signorini
