// Discontinuities of the forcing, and what the time loop will cost.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/decay.hpp"
#include "study/check/check_parts.hpp"

namespace signorini::checks {
namespace {

// Measured with order 5 on models/pipeline.toml and tests/cases/07: 12, 29, 67, 144 steps in the shortest
// period at rtol 1e-4, 1e-6, 1e-8, 1e-10. That is accuracy, h ~ rtol^(1/6), down to the bound of stability.
constexpr double steps_at_stability = 12.0, steps_at_unit_tolerance = 3.1;
// Of a step: of its own, and for each unknown. On a machine of 2024, one thread.
constexpr double seconds_per_step = 1e-6, seconds_per_unknown = 2e-8;
// Engine exact, measured on models/pipeline.toml at three finenesses: radians of omega_max a step.
constexpr double exact_radians = 5.3, exact_per_step = 4e-6, exact_per_unknown = 3.5e-7;
// Engines with steps of given length, measured on models/pipeline.toml and a single mass.
constexpr double fixed_per_step = 3e-7, fixed_per_unknown = 1.6e-8;

/// Does the slope jump at a breakpoint, beyond roundoff?
bool slope_jumps(const History& history, double t) {
  const double before = history.piece_before(t).value(t, 1), after = history.piece(t).value(t, 1);
  return std::abs(after - before) > 1e-12 * (std::abs(before) + std::abs(after));
}

}  // namespace

std::vector<Discontinuity> discontinuities(const Model& model, double t_end) {
  std::vector<Discontinuity> result;
  const auto add = [&](const History& history, bool integral, const std::string& what) {
    for (const Breakpoint& b : history.breakpoints())
      if (b.time >= 0.0 && b.time <= t_end)
        result.push_back({b.time, integral ? slope_jumps(history, b.time) : b.jump, what});
  };
  for (const Load& load : model.loads) add(load.history, false, load.name);
  for (const Contact& c : model.contacts) {
    add(c.normal_force, false, "normal_force of contact '" + c.name + "'");
    add(c.surface_motion, true, "surface_velocity of contact '" + c.name + "'");
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Discontinuity& a, const Discontinuity& b) { return a.t < b.t; });
  return result;
}

Cost cost_of(const Model& model, const Settings& settings, double t_end) {
  Cost cost;
  for (const Dof& dof : model.dofs) cost.unknowns += dof.massless ? 1 : 2;
  cost.unknowns += 2 * static_cast<long>(model.contacts.size());
  cost.omega_max = model.omega_max;
  for (const Load& load : model.loads)
    for (const Piece& piece : load.history.pieces())
      if (piece.amplitude != 0.0) cost.omega_max = std::max(cost.omega_max, piece.omega);
  if (settings.engine == "exact" && cost.omega_max > 0.0) {
    const double fastest = std::max(cost.omega_max, fastest_decay(model));
    cost.steps_per_period = 2.0 * std::numbers::pi / exact_radians * fastest / cost.omega_max;
    cost.steps = t_end * fastest / exact_radians;
    cost.seconds = cost.steps * (exact_per_step + exact_per_unknown * static_cast<double>(cost.unknowns));
    return cost;
  }
  if (settings.dt > 0.0 && cost.omega_max > 0.0) {
    cost.steps_per_period = 2.0 * std::numbers::pi / (cost.omega_max * settings.dt);
    cost.steps = t_end / settings.dt;
    cost.seconds = cost.steps * (fixed_per_step + fixed_per_unknown * static_cast<double>(cost.unknowns));
    return cost;
  }
  if (settings.max_order < 5 || !(cost.omega_max > 0.0)) return cost;
  cost.steps_per_period =
      std::max(steps_at_stability, steps_at_unit_tolerance * std::pow(settings.rtol, -1.0 / 6.0));
  cost.steps = cost.steps_per_period * t_end * cost.omega_max / (2.0 * std::numbers::pi);
  cost.seconds = cost.steps * (seconds_per_step + seconds_per_unknown * static_cast<double>(cost.unknowns));
  return cost;
}

}  // namespace signorini::checks
