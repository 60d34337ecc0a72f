// limits.hpp: how far two runs may differ before `compare` fails.
//
//   Limits limits = parse_limits({"event_time=1e-4", "sequence=0"});   exceeded(limits, comparison)
#pragma once

#include <string>
#include <vector>

#include "study/compare/comparison.hpp"

namespace signorini {

struct Limit {
  std::string name;
  double value = 0.0;
};

/// event_time, displacement, rotation, velocity, angular_velocity, force, force_away, energy, sequence, response:NAME; units
/// of the scene. Errors: UsageError for another name, twice the same, or what is no number >= 0.
[[nodiscard]] std::vector<Limit> parse_limits(const std::vector<std::string>& texts);

/// The quantities of a comparison by the names of limits, with their unit.
struct Quantity {
  std::string name, unit;
  const Deviation* deviation;
};
[[nodiscard]] std::vector<Quantity> quantities(const Comparison& comparison, const Units& units);

/// Their names, in the same order.
[[nodiscard]] std::vector<std::string> quantity_names();

/// One sentence for each limit that is exceeded: "exact: displacement 3e-6 m at t = 0.1 (A.ux) exceeds ...".
/// A run that ended early, or has nothing to compare, keeps no limit. Events without a partner break
/// event_time, unless `sequence` has a limit of its own.
[[nodiscard]] std::vector<std::string> exceeded(const std::vector<Limit>& limits, const RunFigures& reference,
                                                const RunFigures& other, const Comparison& comparison);

}  // namespace signorini
