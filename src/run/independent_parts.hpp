// independent_parts.hpp: runs uncoupled parts of a model separately, each with its own time steps.
//
//   for s = s_1 < s_2 < ... t_end:   run every part to s;   merge and forward the rows up to the time that all reached
//
// A stage (from one s to the next) is t_end / 32 at most, and shorter if there are many events. The ends of stages do
// not influence results. The cost of n equal parts is n times the cost of one part; in a common run, each event of one
// part would need a pass over all parts. The data for decisions (scales, velocity below which rebounds come to rest) are
// those of the whole model. If a part stops, the other parts end at the same time. Listeners, steering, and records of
// both sides of instants need one motion of the whole model, so the parts then run together (parts_to_run).
#pragma once

#include "model/assembly/parts.hpp"
#include "run/loop.hpp"

namespace signorini::run {

// Joins the results of parts that ran separately into one report.
//
//   works, energies, counters, scales of energy:   sums over parts
//   extremes:                                      the largest of all parts; the error of the energy balance is the sum of
//                                                  the largest errors of the parts: an upper bound
//
// All values are in the units of the whole model.

/// Adds the results of the parts to `report`, which contains outcome, method, events and load jumps of the whole model
/// already. Returns the sum of RunEnd::energy_rounding over the parts.
double merge_results(const Model& whole, const std::vector<assembly::PartModel>& parts,
                     const std::vector<RunEnd>& endings, Report& report);

/// Runs the parts of `whole`, in the units of `whole`. spec.engine must not be automatic.
[[nodiscard]] RunEnd run_independent_parts(const Model& whole, std::vector<assembly::PartModel> parts,
                                           const RunSpec& spec, const EngineRow& engine, Method method,
                                           Recorder& recorder);

/// Parts of the model that are to run separately; empty: the model runs as a whole.
[[nodiscard]] std::vector<assembly::PartModel> parts_to_run(const Model& model, const Method& method,
                                                            const Recorder& recorder, const RunHooks& hooks);

}  // namespace signorini::run
