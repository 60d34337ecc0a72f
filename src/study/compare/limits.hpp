// limits.hpp: allowed differences of two runs, beyond which `compare` fails.
//
//   Limits limits = parse_limits({"event_time=1e-4", "sequence=0"});   exceeded(limits, comparison)
#pragma once

#include <string>
#include <vector>

#include "study/compare/comparison.hpp"

namespace signorini::compare {

struct Limit {
  std::string name;
  double value = 0.0;
};

/// Parses limits NAME=VALUE in the units of the scene. Names: event_time, displacement, rotation, velocity,
/// angular_velocity, force, force_away, energy, sequence, response:NAME. Errors: UsageError for another name,
/// a repeated name, or a value that is not a number >= 0.
[[nodiscard]] std::vector<Limit> parse_limits(const std::vector<std::string>& texts);

/// A compared quantity with the name of its limit and its unit.
struct Quantity {
  std::string name, unit;
  const Deviation* deviation;
};
/// All quantities of a comparison.
[[nodiscard]] std::vector<Quantity> quantities(const Comparison& comparison, const Units& units);

/// Names of the quantities, in the order of quantities().
[[nodiscard]] std::vector<std::string> quantity_names();

/// Numbers of compared rows, and of rows of both runs: "history.csv 201, contacts.csv 21 of 201 and 101".
[[nodiscard]] std::string rows_compared(const Comparison& comparison);

/// One sentence for each exceeded limit: "exact: displacement 3e-6 m at t = 0.1 (A.ux) exceeds ...". A limit
/// is also exceeded if the comparison does not cover both runs completely: one run ended early or continues
/// beyond the other, a column or contact exists in only one run or in none, or a row of a table has no
/// partner. Events without a partner exceed event_time, unless `sequence` has its own limit.
[[nodiscard]] std::vector<std::string> exceeded(const std::vector<Limit>& limits, const RunFigures& reference,
                                                const RunFigures& other, const Comparison& comparison);

}  // namespace signorini::compare
