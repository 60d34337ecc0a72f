// joined_report.hpp: joins the results of parts that ran separately into one report.
//
//   works, energies, counters, scales of energy:   sums over parts
//   extremes:                                      the largest of any part; error of the balance: the sum of the parts'
//                                                  largest errors, an upper bound at any instant
//
// All values are in the units of the whole model.
#pragma once

#include "model/assembly/part_models.hpp"
#include "run/loop.hpp"

namespace signorini {

/// Adds the results of the parts to `report`, which has outcome, method, events and load jumps of the whole model
/// already. Returns the sum of RunEnd::energy_rounding.
double join(const Model& whole, const std::vector<PartModel>& parts, const std::vector<RunEnd>& endings,
            Report& report);

}  // namespace signorini
