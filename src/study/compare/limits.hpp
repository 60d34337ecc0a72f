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

/// The rows that were compared, and those of either run: "history.csv 201, contacts.csv 21 of 201 and 101".
[[nodiscard]] std::string rows_compared(const Comparison& comparison);

/// One sentence for each limit that is exceeded: "exact: displacement 3e-6 m at t = 0.1 (A.ux) exceeds ...".
/// No limit is kept where what was compared is not the whole of both runs: one ended early or goes on beyond the other,
/// a column or contact is in one of them only or in none, a row of a table has no partner. Events without a partner
/// break event_time, unless `sequence` has a limit of its own.
[[nodiscard]] std::vector<std::string> exceeded(const std::vector<Limit>& limits, const RunFigures& reference,
                                                const RunFigures& other, const Comparison& comparison);

}  // namespace signorini
