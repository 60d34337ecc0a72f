#include "run/breakpoints.hpp"

#include <algorithm>

#include "motion/clock.hpp"

namespace signorini {

std::vector<Breakpoint> breakpoints(const Model& model, double t_end) {
  std::vector<Breakpoint> all;
  const auto add = [&](const History& history, bool values) {
    for (Breakpoint b : history.breakpoints()) {
      b.jump = b.jump && values;
      if (b.time > 0.0 && b.time < t_end) all.push_back(b);
    }
  };
  for (const Load& load : model.loads) add(load.history, true);
  for (const Contact& contact : model.contacts) {
    add(contact.normal_force, true);
    add(contact.surface_motion, false);
  }
  std::sort(all.begin(), all.end(), [](const Breakpoint& a, const Breakpoint& b) { return a.time < b.time; });
  std::vector<Breakpoint> merged;
  for (const Breakpoint& b : all) {
    if (!merged.empty() && b.time - merged.back().time <= resolution_at(b.time, 0.0))
      merged.back().jump = merged.back().jump || b.jump;
    else
      merged.push_back(b);
  }
  return merged;
}

}  // namespace signorini
