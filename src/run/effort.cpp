#include "run/effort.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/decay.hpp"

namespace signorini {
namespace {

/// Seconds of a step: of its own, and for each unknown. On a machine of 2024, one thread.
struct StepTime {
  double own, unknown;
};

// Measured with order 5 on models/pipeline.toml and tests/cases/07: 12, 29, 67, 144 steps in the shortest
// period at rtol 1e-4, 1e-6, 1e-8, 1e-10. That is accuracy, h ~ rtol^(1/6), down to the bound of stability.
constexpr double steps_at_stability = 12.0, steps_at_unit_tolerance = 3.1;
constexpr StepTime time_of_bdf = {1e-6, 2e-8};
// Measured on models/pipeline.toml at three finenesses: radians of omega_max a step.
constexpr double radians_of_series = 5.3;
constexpr StepTime time_of_series = {4e-6, 3.5e-7};
// Measured on models/pipeline.toml and a single mass.
constexpr StepTime time_of_fixed_steps = {3e-7, 1.6e-8};

Effort effort(double steps_per_period, double steps, const StepTime& time, long unknowns) {
  return {steps_per_period, steps, steps * (time.own + time.unknown * static_cast<double>(unknowns))};
}

}  // namespace

Effort effort_of_series(const EffortParts& parts) {
  const double fastest = std::max(parts.omega_max, fastest_decay(parts.model));
  return effort(2.0 * std::numbers::pi / radians_of_series * fastest / parts.omega_max,
                parts.run.t_end * fastest / radians_of_series, time_of_series, parts.unknowns);
}

Effort effort_of_bdf(const EffortParts& parts) {
  if (parts.method.max_order < 5) return {};
  const double steps_per_period =
      std::max(steps_at_stability, steps_at_unit_tolerance * std::pow(parts.run.rtol, -1.0 / 6.0));
  return effort(steps_per_period,
                steps_per_period * parts.run.t_end * parts.omega_max / (2.0 * std::numbers::pi), time_of_bdf,
                parts.unknowns);
}

Effort effort_of_fixed_steps(const EffortParts& parts) {
  const double dt = parts.method.accuracy;
  return effort(2.0 * std::numbers::pi / (parts.omega_max * dt), parts.run.t_end / dt, time_of_fixed_steps,
                parts.unknowns);
}

}  // namespace signorini
