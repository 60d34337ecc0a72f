#include "differential/promise.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace signorini::differential {
namespace {

constexpr double sharp = 3.0;  // t_uncertainty of both runs

/// Found in units of what is allowed; neither a value nor a neighbour that is not finite is allowed anything.
double excess(double found, double allowed) {
  const double ratio = found / allowed;
  return std::isfinite(ratio) && std::isfinite(allowed) ? ratio : Deviation::never;
}

void compare(const std::vector<double>& found, const std::vector<double>& spread, const Promise& promise,
             const char* name, Finding& finding) {
  for (std::size_t i = 0; i < std::min(found.size(), spread.size()); ++i) {
    const double allowed = promise.factor * spread[i] + promise.delta;
    if (excess(found[i], allowed) <= finding.worst) continue;
    finding.worst = excess(found[i], allowed);
    finding.what = fmt::format("{} at row {}: {:.2e}, allowed {:.2e}", name, i, found[i], allowed);
  }
}

}  // namespace

Finding check(const Deviation& d, const Promise& promise) {
  Finding finding;
  const Deviation& spread = promise.spread;
  finding.to_end = d.complete && spread.complete;
  finding.until = finding.to_end ? d.reached : std::min(d.reached, spread.reached);
  compare(d.u, spread.u, promise, "displacement", finding);
  compare(d.v, spread.v, promise, "velocity", finding);
  compare(d.force, spread.force, promise, "force", finding);
  for (const auto& [contact, times] : d.time) {
    const auto of = spread.time.find(contact);
    if (of == spread.time.end()) continue;
    for (std::size_t j = 0; j < std::min(times.size(), of->second.size()); ++j) {
      const double blur = d.uncertainty.at(contact)[j];
      const double by_spread = promise.factor * of->second[j] + promise.least_time;
      const double allowed = by_spread + promise.blur * blur;
      ++finding.times;
      finding.sharp_times += times[j] <= by_spread + sharp * blur ? 1 : 0;
      if (excess(times[j], allowed) <= finding.worst) continue;
      finding.worst = excess(times[j], allowed);
      finding.what =
          fmt::format("event {} of '{}': {:.2e}, allowed {:.2e}", j + 1, contact, times[j], allowed);
    }
  }
  finding.kept = finding.worst <= 1.0;
  // Where the spread has parted already, or parts with the next event, the sequence is not determined.
  const bool undetermined = spread.splits() && spread.aligned <= d.aligned + 1;
  finding.unresolved = d.splits() && !undetermined && d.room <= promise.resolution;
  if (d.splits() && !undetermined && !finding.unresolved) {
    finding.kept = false;
    finding.what = fmt::format("sequences part at {:.9g} after {} events: {}", d.until, d.aligned, d.split);
  }
  return finding;
}

}  // namespace signorini::differential
