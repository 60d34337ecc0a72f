#include "run/effort.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/decay.hpp"
#include "run/choose_flow.hpp"

namespace signorini {
namespace {

/// Seconds per step: a constant, and a term per unknown. Measured on a machine of 2024, one thread.
struct StepTime {
  double own, unknown;
};

// Measured with order 5 on models/pipeline.toml and tests/cases/07: 12, 29, 67, 144 steps in the shortest period at
// rtol 1e-4, 1e-6, 1e-8, 1e-10. The step is limited by accuracy, h ~ rtol^(1/6), and by stability.
constexpr double steps_at_stability = 12.0, steps_at_unit_tolerance = 3.1;
constexpr StepTime time_of_bdf = {1e-6, 2e-8};
// Measured on models/pipeline.toml with three meshes: radians of omega_max per step.
constexpr double radians_of_series = 5.3;
constexpr StepTime time_of_series = {4e-6, 3.5e-7};
// Measured on beams with 100, 300 and 1000 contacts, 3 unknowns per contact: 0.5, 1.8, 4.2 ms.
constexpr StepTime time_of_event = {1e-5, 1.5e-6};
// Measured on models/pipeline.toml and a single mass.
constexpr StepTime time_of_fixed_steps = {3e-7, 1.6e-8};

// Measured on models/pipeline.toml at 51, 201 and 801 unknowns, 1.2 s: 1218, ... proven stretches; 0.04, 0.38, 4.4 s
// in all with real modes; a state in complex modes 6 and 45 ms at 51 and 99 unknowns.
constexpr double gain_of_modes = 2e-3, time_of_modes = 4e-5, order_of_modes = 1.7;
constexpr double usual_states = 16.0, time_of_damped_state = 4.5e-8;
constexpr StepTime time_of_proof = {1e-5, 1e-7}, time_of_damped_proof = {3e-5, 1e-6};

Effort effort(double steps_per_period, double steps, const StepTime& time, long unknowns) {
  return {steps_per_period, steps, steps * (time.own + time.unknown * static_cast<double>(unknowns))};
}

Effort effort_of_series(const Model& model, const RunSpec& run, double omega_max) {
  const double fastest = std::max(omega_max, fastest_decay(model));
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

Effort effort_of_exact(const EffortParts& parts) {
  Effort result = effort_of_series(parts.model, parts.run, parts.omega_max);
  result.by_series = result.seconds;
  const ModalKind kind = modal_kind(parts.model);
  if (kind.crowded || !kind.objection.empty()) return result;
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
