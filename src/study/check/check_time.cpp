// Discontinuities of the forcing, and what the time loop will cost.
#include <algorithm>
#include <cmath>

#include "run/expected.hpp"
#include "study/check/check_parts.hpp"

namespace signorini::checks {
namespace {

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

Cost cost_of(const Model& model, const RunSpec& run, const Method& method) {
  RunSpec chosen = run;
  chosen.engine = method.engine;
  const Expected found = expected(model, run, method);
  return {found.unknowns, found.omega_max, found.effort, exact_instead(model, chosen)};
}

}  // namespace signorini::checks
