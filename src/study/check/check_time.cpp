// Discontinuities of the forcing, and estimated cost of the time loop.
#include <algorithm>
#include <cmath>

#include "run/expected.hpp"
#include "study/check/check_parts.hpp"

namespace signorini::checks {
namespace {

/// True if the slope jumps at a breakpoint, beyond rounding.
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

Cost cost_of(const Model& model, const RunSpec& run, const Method& method) {
  RunSpec chosen = run;
  chosen.engine = method.engine;
  const Expected found = expected(model, run, method);
  return {found.unknowns, found.omega_max, found.effort, exact_instead(model, chosen), {}};
}

}  // namespace signorini::checks

namespace signorini {

void measure_cost(const Scene& scene, const Model& model, std::vector<double> cutoffs, CheckReport& report) {
  constexpr double patience = 0.5, long_run = 2.0;  // s
  const Engine own = report.method.engine;
  report.cost.trials = trials(scene, model, own, cutoffs, patience);
  if (!cutoffs.empty() || scene.reduction || report.stuck.modes.empty()) return;
  const auto found = std::find_if(report.cost.trials.begin(), report.cost.trials.end(),
                                  [&](const Trial& trial) { return trial.engine == own; });
  const double cutoff = cutoff_to_try(report.stuck.modes.front().omega, report.cost.omega_max);
  if (cutoff > 0.0 && found != report.cost.trials.end() && found->seconds > long_run)
    report.cost.trials = trials(scene, model, own, {cutoff}, patience);
}

}  // namespace signorini
