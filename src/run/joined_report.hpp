// joined_report.hpp: what parts that ran apart have found, as one report.
//
//   works, energies, counters, scales of energy:   sums over parts
//   extremes:                                      the greatest of any part; what the balance is off by: the sum of the
//                                                  parts' greatest, which no instant exceeds
//
// In the units of the whole.
#pragma once

#include "model/assembly/part_models.hpp"
#include "run/loop.hpp"

namespace signorini {

/// Adds what the parts have found to `report`, which has outcome, method, events and jumps of loads of the whole.
/// Returns the sum of RunEnd::energy_rounding.
double join(const Model& whole, const std::vector<PartModel>& parts, const std::vector<RunEnd>& endings,
            Report& report);

}  // namespace signorini
